"""Macros of C++ that headers define for the files that include them."""
