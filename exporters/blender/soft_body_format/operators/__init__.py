"""What a menu or a button starts."""
