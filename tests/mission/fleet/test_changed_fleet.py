"""A fleet with a robot more is what it would be if all were looked at, and as sound."""

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from viaspline.errors import MissionError
from viaspline.mission.fleet.changed_fleet import changed_fleet
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission

WORLD = {"bounds": [-5, -5, 45, 45], "known": [{"circle": {"center": [20, 20], "radius": 2}}]}
BEFORE = Fleet.of(
    [
        FleetMember(
            f"r{k}",
            Mission.model_validate({"world": WORLD, "route": {"start": [x, 0], "goal": [x, 40]}}),
            rest="leave" if k % 2 else "stay",
        )
        for k, x in enumerate((0.0, 10.0, 20.0, 30.0))
    ],
    1.0,
)
POINTS = st.tuples(
    st.sampled_from([0.0, 1.5, 10.0, 20.0, 35.0]), st.sampled_from([0.0, 20.0, 40.0])
)
ROUTES = st.fixed_dictionaries(
    {"start": POINTS},
    optional={"goal": POINTS, "via": st.lists(POINTS, max_size=2), "closed": st.booleans()},
)


def made(make: Any) -> Any:
    try:
        fleet = make()
    except MissionError as error:
        return str(error)
    kept = [one.model_fields_set for one in fleet.fleet]
    return fleet, fleet.model_fields_set, kept, fleet.members


@given(
    route=ROUTES,
    name=st.sampled_from(["r0", "r2", "new"]),
    radius=st.sampled_from([0.3, 3.0]),
    rest=st.sampled_from(["stay", "leave"]),
    priority=st.sampled_from([0.0, 2.0, 1e12]),
    world=st.sampled_from([WORLD, {}, {"bounds": [-9, -9, 60, 60]}]),
)
def test_a_changed_fleet_is_the_one_of_all_its_members(
    route: Any, name: str, radius: float, rest: Any, priority: float, world: Any
) -> None:
    try:
        given_one = Mission.model_validate(
            {"world": world, "robot": {"radius_m": radius}, "route": route}
        )
    except MissionError:
        return
    changed = FleetMember(name, given_one, priority, rest)
    members = [changed if one.name == name else one for one in BEFORE.members]
    members += [] if name == "r0" or name == "r2" else [changed]
    assert made(lambda: changed_fleet(BEFORE, members, changed)) == made(
        lambda: Fleet.of(members, BEFORE.separation_m)
    )
