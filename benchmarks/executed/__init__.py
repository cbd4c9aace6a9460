"""Small programs that are drawn, run for real and read by the tool: what the tool says against what they did."""
