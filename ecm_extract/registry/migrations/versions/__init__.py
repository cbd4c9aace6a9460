"""One file for each revision of the tables; a file that was released never changes."""
