"""Reading: every artefact of a tree through its parser, once, on all cores."""
