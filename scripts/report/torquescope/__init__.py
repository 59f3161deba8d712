"""Identifies robot dynamics from recordings and names the physics a model lacks."""
