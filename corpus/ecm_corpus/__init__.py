"""Cases of documented integration bugs: reconstruct, score, statistics."""
