from __future__ import annotations

from typing import Any

import pytest

from viaspline.fleet.laying.lay_paths import lay_paths
from viaspline.fleet.laying.laying_workers import Cluster
from viaspline.mission.fleet.fleet import Fleet


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_lays_the_same_bytes_though_one_of_its_workers_is_killed() -> None:
    distributed: Any = pytest.importorskip("distributed")
    fleet = Fleet.model_validate({
        "separation_m": 1,
        "spline": {"tension": 0.0},
        "fleet": [
            {"name": f"r{k}", "route": {"start": [4 * k, 0], "goal": [110 - 4 * k, 20 + 3 * k]}}
            for k in range(28)
        ],
    })  # fmt: skip
    here = lay_paths(fleet)
    killed = []
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):

        def kill_one(done: int, of: int) -> None:
            if not killed:
                nanny = cluster.workers[0]
                nanny.process.process.kill()
                killed.append(nanny)

        there = lay_paths(fleet, kill_one, workers=Cluster(client))
    assert killed
    assert list(there.plans) == list(here.plans)
    for name, plan in there.plans.items():
        assert plan.path.spans.tobytes() == here.plans[name].path.spans.tobytes()
