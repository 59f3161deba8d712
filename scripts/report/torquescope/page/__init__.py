"""The page of a result and its figures. Needs matplotlib, and jinja2 for the page."""
