"""Maps on disk: ROS map_server files, plans that are drawn, labelled locations."""
