"""Registered environments: `gymnasium.make("Ensonify/AltitudeHold-v0")`, and those of several vehicles, which PettingZoo keeps no
register of: `ensonify.tasks.keep_formation.KeepFormation()`. Each has a file of its own and a launch file."""
import gymnasium

TASKS = {"AltitudeHold": "altitude_hold", "BottomFollow": "bottom_follow", "WallFollow": "wall_follow", "TargetSearch": "target_search"}
TEAM_TASKS = {"KeepFormation": "keep_formation"}


def register() -> None:
    """Makes the tasks known to Gymnasium, once."""
    for name, module in TASKS.items():
        if f"Ensonify/{name}-v0" not in gymnasium.registry:
            gymnasium.register(f"Ensonify/{name}-v0", entry_point=f"ensonify.tasks.{module}:{name}")
