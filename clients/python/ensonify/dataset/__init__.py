"""Pictures of the scenes of `ensonify dataset`, and the set that they become.

A scene's run ends with its pictures, in one file beside it; when all are there they are joined: formats by split, a
manifest with a row for each picture, and a card that says what is in the set.
"""
