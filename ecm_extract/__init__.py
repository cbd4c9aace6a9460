"""From a source tree to contracts: discover, read, link, assemble, report."""
