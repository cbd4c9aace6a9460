"""What people declare (`ecm.yaml`), laid over what was read; where the two contradict each other, `drift`."""
