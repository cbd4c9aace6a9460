"""Whose a declaration is: modules, programs and plugins, and what each of them reaches."""
