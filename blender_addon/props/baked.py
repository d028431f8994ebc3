"""Settings that keys and drivers leave alone: Apply bakes them, and only the day plays."""

from typing import TypeVar

Group = TypeVar("Group", bound=type)


def baked(cls: Group) -> Group:
    """Let no property of a group be keyed or driven: between two Applies nothing would follow."""
    for deferred in cls.__annotations__.values():
        options = deferred.keywords.get("options", set())
        deferred.keywords["options"] = options - {"ANIMATABLE"}
    return cls
