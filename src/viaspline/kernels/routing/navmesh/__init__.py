"""Any-angle shortest paths on a lattice: free rectangles and Polyanya."""
