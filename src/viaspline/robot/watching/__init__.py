"""The model is watched: what the machine does is compared with what its model says."""
