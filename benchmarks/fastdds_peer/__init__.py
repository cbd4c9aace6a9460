"""A peer of another vendor of DDS."""
