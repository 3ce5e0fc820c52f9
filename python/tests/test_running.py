"""Progress, Ctrl-C, threads and processes."""

import _thread
import concurrent.futures
import multiprocessing
import os
import signal
import threading

import numpy as np
import prohull
import pytest

TAKES_SECONDS = dict(target_faces=100, tight=True, best_of=50)


def test_progress_is_told_on_the_calling_thread(pony):
    told = []
    prohull.build(pony, target_faces=300, tight=True,
                  progress=lambda stage, fraction: told.append((stage, fraction, threading.get_ident())))
    assert told[-1][:2] == ("done", 1.0)
    assert all(0 <= fraction <= 1 for _, fraction, _ in told)
    assert {thread for _, _, thread in told} == {threading.get_ident()}


@pytest.mark.parametrize("work, stages", [
    (lambda mesh, rays, progress: mesh.first_hit(*rays, progress=progress), {"query"}),
    (lambda mesh, rays, progress: mesh.any_hit(*rays, progress=progress), {"query"}),
    (lambda mesh, rays, progress: mesh.all_hits(*rays, progress=progress), {"query"}),
    (lambda mesh, rays, progress: mesh.contains(rays[0], progress=progress), {"query"}),
    (lambda mesh, rays, progress: mesh.closest(rays[0], progress=progress), {"query"}),
    (lambda mesh, rays, progress: mesh.signed_distance(rays[0], progress=progress), {"query"}),
    (lambda mesh, rays, progress: mesh.faces_met(np.zeros((1000, 9)), progress=progress), {"query"}),
    (lambda mesh, rays, progress: prohull.Collider(mesh).collides(mesh, np.tile(np.eye(4), (5000, 1, 1)), progress=progress),
     {"collide"}),
    (lambda mesh, rays, progress: prohull.verify(mesh, mesh, progress=progress), {"verify"}),
    (lambda mesh, rays, progress: prohull.distance_bounds(mesh, mesh, progress=progress), {"measure"}),
])
def test_all_that_takes_long_tells_progress(pony, random, work, stages):
    rays, told = random().normal(size=(2, 20000, 3)), []
    work(pony, rays, lambda *state: told.append((*state, threading.get_ident())))
    assert told[0][:2] == ("start", 0.0) and told[-1][:2] == ("done", 1.0)
    assert {stage for stage, _, _ in told[1:-1]} <= stages | {"start"}
    assert {thread for _, _, thread in told} == {threading.get_ident()}
    with pytest.raises(KeyboardInterrupt, match="progress returned False"):
        work(pony, rays, lambda stage, fraction: False)
    with pytest.raises(KeyboardInterrupt, match="progress returned False"):
        work(pony, rays, lambda stage, fraction: np.float64(fraction) < 0)
    work(pony, rays, lambda stage, fraction: 0)


def test_progress_can_stop_a_build(pony):
    stages = []

    def progress(stage, fraction):
        stages.append(stage)
        return stage == "start"

    with pytest.raises(KeyboardInterrupt, match="progress returned False"):
        prohull.build(pony, progress=progress, **TAKES_SECONDS)
    assert set(stages[:-1]) == {"start"} and stages[-1] not in ("start", "done")


def test_what_progress_raises_goes_on_to_the_caller(pony):
    def progress(stage, fraction):
        if stage != "start":
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        prohull.build(pony, progress=progress, **TAKES_SECONDS)


@pytest.mark.parametrize("work", ["build", "query"])
def test_ctrl_c_interrupts(random, work):
    """As Ctrl-C does, by a signal to the main thread while it waits in C++ for what would take an hour."""
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in the background of a shell
    mesh, rays = prohull.sample("pony", 200000), random().normal(size=(2, 2000000, 3))
    interrupt = threading.Timer(0.3, _thread.interrupt_main)
    interrupt.start()
    with pytest.raises(KeyboardInterrupt):
        if work == "build":
            prohull.build(mesh, target_faces=100, tight=True, best_of=1000)
        else:
            mesh.all_hits(*rays, engine="brute")
    interrupt.join()
    signal.signal(signal.SIGINT, handler)


def test_other_threads_run_meanwhile(pony):
    ticks = 0
    done = threading.Event()

    def tick():
        nonlocal ticks
        while not done.wait(0.001):
            ticks += 1

    thread = threading.Thread(target=tick)
    thread.start()
    prohull.build(pony, target_faces=300, tight=True)
    done.set()
    thread.join()
    assert ticks


def test_threads_share_a_hull(hull, random):
    rays = random().normal(size=(2, 500, 3))
    expected = hull.first_hit(*rays)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for hits in pool.map(lambda _: hull.first_hit(*rays), range(8)):
            assert np.array_equal(hits.face, expected.face)


def count_threads():
    return len(os.listdir("/proc/self/task"))


def test_idle_threads_end_before_a_fork(pony):
    """A process forked beside them would have their locks, but not them."""
    before = count_threads()
    prohull.build(pony, target_faces=300, threads=2)
    child = os.fork()
    if child == 0:
        os._exit(0)
    os.waitpid(child, 0)
    assert count_threads() <= before


def ask(hull, rays):
    return hull.first_hit(*rays).face, prohull.build(hull, target_faces=100).certified


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_share_a_hull(hull, random, method):
    rays = random().normal(size=(2, 100, 3))
    expected = hull.first_hit(*rays).face  # with threads, before the processes start
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context(method)) as pool:
        for face, certified in pool.map(ask, [hull] * 2, [rays] * 2):
            assert np.array_equal(face, expected) and certified
