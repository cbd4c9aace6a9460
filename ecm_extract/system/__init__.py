"""From launch files to the instance graph of a system: node instances, their names, parameters and endpoints."""
