"""What can be drawn: one file a kind of picture, which says what it shows and computes it. Drawing is `report.drawing`'s.

A picture is a frozen record; `trace` computes its data as named tables and arrays. The table named "" is the picture's data for
whoever wants the numbers.
"""

from albedo_lab.pictures.base import Curve, Data, Picture

__all__ = ["Curve", "Data", "Picture"]
