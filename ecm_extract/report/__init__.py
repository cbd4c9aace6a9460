"""Renderers: an extraction as manifests, as one JSON document, as a summary for people."""
