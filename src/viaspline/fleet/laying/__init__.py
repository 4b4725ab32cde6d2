"""The path of each robot of a fleet, among the places where the others rest."""
