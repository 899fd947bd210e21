"""Operators that menus and buttons start."""
