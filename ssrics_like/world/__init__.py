"""The simulated building: floor plan, laser, robot, exploration. Values in, values out."""
