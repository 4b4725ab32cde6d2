"""The search among poses."""
