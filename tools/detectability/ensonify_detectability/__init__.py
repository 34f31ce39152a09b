"""`ensonify detectability`: how well a detector finds the things of a data set, and against what."""
