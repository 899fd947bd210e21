"""Draws joint limits and the last build over the model in the viewport."""
