"""The one exception of this project for input that cannot be used."""


class InputError(ValueError):
    """Input that cannot be used; its message is one sentence with the thing, value and range."""


def require_range(name: str, value: float, low: float, high: float, unit: str = "") -> float:
    """Return `value` if it lies in [low, high].

    Raises
    ------
    InputError
        If it does not, or if it is not a number.
    """
    if not low <= value <= high:
        suffix = f" {unit}" if unit else ""
        raise InputError(f"{name} is {value:g}{suffix}; allowed is {low:g} to {high:g}{suffix}.")
    return value


def require_whole(name: str, value: float, low: int, high: int) -> int:
    """Return `value` as an int if it is a whole number in [low, high].

    Raises
    ------
    InputError
        If it is not.
    """
    given = f"{value:g}" if isinstance(value, float) else value
    if not low <= value <= high:
        raise InputError(f"{name} is {given}; allowed is {low} to {high}.")
    if value != int(value):
        raise InputError(f"{name} is {given}; allowed are whole numbers, {low} to {high}.")
    return int(value)
