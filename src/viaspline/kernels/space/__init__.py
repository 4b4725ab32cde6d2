"""The world in space: solids, voxels and ground as kernels see them."""
