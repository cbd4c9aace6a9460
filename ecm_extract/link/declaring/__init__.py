"""Which calls declare something: rows for libraries, their matches in the code, and the ways from wrappers to them."""
