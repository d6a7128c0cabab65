"""Maps on disk: ROS map_server files, plans that are drawn, labelled locations."""

from ssrics_like.maps.loading import humans_file, is_plan, load_building
from ssrics_like.maps.places import load_choices, load_locations
from ssrics_like.maps.plan_file import load_plan, save_plan
from ssrics_like.maps.saving import save_building

__all__ = [
    "humans_file",
    "is_plan",
    "load_building",
    "load_choices",
    "load_locations",
    "load_plan",
    "save_building",
    "save_plan",
]
