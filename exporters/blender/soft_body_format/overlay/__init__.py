"""What is drawn over the model in the viewport."""
