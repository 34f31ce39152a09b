"""`ensonify plot`: pictures, grids and numbers from a record."""
