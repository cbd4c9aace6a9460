"""From linked modules to contracts: every section that an artefact shows, each value with its evidence."""
