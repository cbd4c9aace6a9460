"""What expressions give: texts, numbers, lists and tables, with holes where nothing in the tree shows the value."""
