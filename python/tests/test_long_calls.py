"""Calls that take long: they end by Ctrl-C, let other threads run, and leave no memory behind."""

import os
import resource
import signal
import subprocess
import sys
import threading
import time

import pytest

import hemilux
from scenes import boxes, room, squares

CALLS = {
    "view_factors": "hemilux.view_factors(boxes(16), 1e-5, of='above:1e-6')",
    "solve": "hemilux.solve(boxes(8, emission=1, reflectance=.9), 'hemisphere', steps=10**6)",
    "compare": "hemilux.compare(boxes(8, emission=1), ['hemisphere'], max_rays=10**12)",
}


@pytest.mark.parametrize("call", CALLS)
def test_ctrl_c_ends_a_call_soon(call):
    script = ("import time, hemilux\nfrom scenes import boxes\n"
              "print('begins', flush=True)\n"
              f"try:\n    {CALLS[call]}\nexcept KeyboardInterrupt:\n    print('interrupted')\n")
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True,
                             cwd=os.path.dirname(__file__))
    try:
        assert child.stdout.readline() == "begins\n"
        time.sleep(1)
        assert child.poll() is None
        began = time.monotonic()
        child.send_signal(signal.SIGINT)
        rest = child.communicate(timeout=30)[0]
        assert rest == "interrupted\n"
        assert time.monotonic() - began < 10
        assert child.returncode == 0
    finally:
        child.kill()


def test_what_progress_raises_ends_the_call():
    class Enough(Exception):
        pass

    seen = []

    def stop(phase, share):
        seen.append((phase, share))
        if len(seen) == 3:
            raise Enough

    with pytest.raises(Enough):
        hemilux.view_factors(boxes(16), 1e-5, of="above:1e-6", progress=stop)
    assert all(isinstance(phase, str) and 0 <= share <= 1 for phase, share in seen)
    assert len(seen) == 3


def test_other_threads_run_meanwhile():
    counted, done = 0, threading.Event()

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    began = time.monotonic()
    hemilux.solve(room(max_edge=.1), "hemisphere", seconds=1)
    seconds = time.monotonic() - began
    done.set()
    thread.join()
    assert counted > 50 * seconds


def test_several_threads_may_compute_at_once():
    mesh = boxes(3)
    expected = hemilux.view_factors(mesh).matrix.data.tobytes()
    found = []
    threads = [threading.Thread(target=lambda: found.append(
        hemilux.view_factors(mesh).matrix.data.tobytes())) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


def test_arrays_outlive_what_they_came_from():
    found = hemilux.view_factors(boxes(3))
    data, copy = found.matrix.data, found.matrix.data.copy()
    assert not found.matrix.data.flags.owndata
    del found
    for _ in range(20):
        hemilux.view_factors(boxes(3), seed=2)
    assert (data == copy).all()


def test_memory_does_not_grow():
    def once():
        mesh = boxes(2, emission=1)
        hemilux.view_factors(mesh).by(["a"] * len(mesh))
        hemilux.solve(mesh, steps=2)
        hemilux.density(mesh, 0)
        hemilux.rays(mesh).count([[0, 0, 9]], [[0, 0, -1]])
        with pytest.raises(ValueError):
            hemilux.solve(squares("floor", "wall"))

    def peak():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    for _ in range(20):
        once()
    before = peak()
    for _ in range(100):
        once()
    assert peak() - before < 100 * 16  # kilobytes; one call takes more for its arrays
