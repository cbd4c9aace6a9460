"""C++ and Python source: one set of facts for both languages."""
