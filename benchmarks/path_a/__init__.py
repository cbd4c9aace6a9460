"""Path A: what contracts predict, confirmed or refuted by the middleware itself."""
