"""What happens when a function runs: the ways through its body, and what its variables hold on each."""
