"""The contract model, the rules and the operations. Knows no parser, no file system, no corpus."""
