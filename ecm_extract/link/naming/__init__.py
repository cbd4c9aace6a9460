"""What things are called: nodes, the handles that names are relative to, and names in the graph."""
