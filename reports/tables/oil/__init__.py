"""Oil film of the bearings and safety of the journals."""
