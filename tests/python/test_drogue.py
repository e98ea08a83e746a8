# SPDX-License-Identifier: Apache-2.0
"""The Python package against the golden vectors and the host program: the same bits, whatever the way.

DROGUE_PROGRAM names the program; without it what needs it is skipped."""
import hashlib
import json
import os
import pathlib
import subprocess
import threading

import numpy as np
import pytest

import drogue

ROOT = pathlib.Path(__file__).resolve().parents[2]
VECTORS = ROOT / 'vectors'
STATUSES = ['ok', 'argument', 'region', 'workspace', 'labels_full', 'edges_full', 'arcs_full', 'no_edges', 'no_arcs',
            'no_ellipse', 'too_few_points', 'degenerate', 'no_inner_part', 'domain', 'behind_camera']
DEMO = drogue.Camera(1465.5, 1465.5, 403.5, 143.5)
MODEL = drogue.Model(0.35, 0.12, 0.25)
REGION = (152, 134, 214, 214)


def q(value, bits=16):
    exact = np.ldexp(value, bits)
    assert np.all(exact == np.rint(exact))
    return [int(v) for v in np.atleast_1d(exact)]


def ellipse_words(e):
    return [0] * 5 if e is None else [w for v in (e.xc, e.yc, e.a, e.b, e.angle_rad) for w in q(v)]


def pose_words(p):
    return [0] * 8 if p is None else q(p.position_m) + q(p.axis) + q(p.yaw_rad) + q(p.pitch_rad)


def words_of(r):
    """A result as the four arrays of the stage 'frame' (vectors/README.md)."""
    inner = r.inner
    frame = [STATUSES.index(r.status)] + ellipse_words(r.ellipse) + ellipse_words(r.ideal)
    frame += [('dark', 'bright', 'mixed').index(r.polarity), sum(1 << k for k in range(4) if r.arcs[k] is not None)]
    frame += [r.refit_points, int(r.has_inner)]
    frame += [0] * 5 if inner is None else q(inner.x) + q(inner.y) + [inner.area, inner.threshold] + q(inner.spread)
    frame += pose_words(r.pose) + pose_words(r.alternative) + [int(r.orientation_resolved)] + q(r.ambiguity)
    detail = list(r.region) + [r.edge_count, r.arc_count] + [-1 if a is None else a for a in r.arcs]
    detail += [w for v in (r.quality.fit_ratio, r.quality.length_ratio, r.quality.axis_ratio, r.quality.score,
                           r.quality.reliability) for w in q(v)]
    detail += [r.cluster_members] + q(r.cover) + q(r.doubt)
    if r.covariance is None:
        return {'frame': frame, 'detail': detail, 'covariance': [0] * 15, 'std': [0] * 4}
    return {'frame': frame, 'detail': detail, 'covariance': q(r.covariance[np.tril_indices(5)], 48),
            'std': q(r.position_std_m, 32) + q(r.axis_std_rad, 32)}


def digest(arrays):
    sha = hashlib.sha256()
    for array in arrays:
        sha.update(np.asarray(array, np.int64).tobytes())
    return sha.hexdigest()


def test_every_frame_of_the_vectors_has_the_librarys_digest():
    ours, theirs, count = [], [], 0
    for case in drogue.vectors.load(VECTORS, stage='frame'):
        camera = drogue.Camera(*(case.inputs['camera'] / 65536))
        words = case.inputs['model'] / 65536
        if camera.fx <= 0 or camera.fy <= 0 or not (words[0] > 0 and 0 <= words[1] <= words[0] and words[2] >= 0):
            continue  # what the dataclasses refuse before the library can
        x, y, width, height = (int(v) for v in case.inputs['region'])
        if width > 1 << 20 or height > 1 << 20 or abs(x) > 1 << 20 or abs(y) > 1 << 20:
            continue
        found = words_of(drogue.measure(case.inputs['image'], camera, drogue.Model(*words), (x, y, width, height)))
        for name, expected in case.exact.items():
            ours.append(found[name])
            theirs.append(expected)
            assert found[name] == [int(w) for w in expected], (case.id, name)
        count += 1
    assert count >= 95
    assert digest(ours) == digest(theirs)


def test_three_lines():
    image = drogue.images.read(VECTORS / 'frame/demo.png')
    truth = json.loads((VECTORS / 'frame/demo.json').read_text())
    pose = drogue.measure(image, DEMO, MODEL).pose
    assert np.allclose(pose.position_m, truth['position_m'], atol=0.005)
    assert abs(np.linalg.norm(pose.axis) - 1) < 1e-4


def program(*arguments):
    path = os.environ.get('DROGUE_PROGRAM')
    if path is None:
        pytest.skip('DROGUE_PROGRAM is not set')
    return subprocess.run([path, *map(str, arguments)], stdout=subprocess.PIPE, check=True, text=True).stdout


def test_same_as_the_program():
    image = VECTORS / 'frame/demo.png'
    out = json.loads(program('measure', image, '--camera', '1465.5,1465.5,403.5,143.5', '--drogue', '0.35,0.12,0.25', '--roi',
                             '152,134,214,214', '--json', '--set', 'min_cover=0.5'))
    r = drogue.measure(drogue.images.read(image), DEMO, MODEL, REGION, {'min_cover': 0.5})
    assert np.allclose(r.pose.position_m, out['position_m'], atol=1e-6, rtol=0)
    assert np.allclose(r.covariance, out['covariance'], rtol=1e-5)
    assert (r.cover, r.cluster_members, list(r.region)) == (out['cover'], out['cluster_members'], out['region'])
    assert abs(r.pose.yaw_deg - out['yaw_deg']) < 1e-4


def test_tracker():
    image = drogue.images.read(VECTORS / 'frame/demo.png')
    tracker = drogue.Tracker(DEMO, MODEL, REGION, max_missed=2)
    states = [tracker.frame(f, 0.04).state for f in (image, image, np.zeros_like(image), image)]
    assert states == ['tracking', 'tracking', 'coasting', 'tracking']
    last = tracker.frame(image, 0.04)
    assert last.raw.ok and not last.gated and np.all(last.filtered.position_std_m > 0)
    assert np.allclose(last.filtered.velocity_mps, 0, atol=0.05)
    black = np.zeros_like(image)
    assert [tracker.frame(black).state for _ in range(3)] == ['coasting', 'coasting', 'lost']
    assert tracker.frame(black).filtered is None
    assert drogue.Tracker(DEMO, MODEL, REGION, min_reliability=0.9).frame(image).state == 'tracking'
    assert drogue.Tracker(DEMO, MODEL, REGION, min_reliability=1).frame(image).state == 'lost'  # it is 0.9999
    with pytest.raises(ValueError, match='min_reliability'):
        drogue.Tracker(DEMO, MODEL, REGION, min_reliability=1.5)


def test_search_and_canny():
    image = drogue.images.read(VECTORS / 'frame/demo.png')
    best = drogue.search(image)[0]
    truth = json.loads((VECTORS / 'frame/demo.json').read_text())['ellipse']
    assert abs(best.x - truth['xc_px']) < 10 and abs(best.y - truth['yc_px']) < 10
    for case in drogue.vectors.load(VECTORS, stage='canny'):
        low, high, smooth = (int(v) for v in case.inputs['params'])
        found = drogue.canny(case.inputs['image'], low, high, bool(smooth))
        assert np.array_equal(found, case.exact['map']), case.id


def test_arrays_of_any_layout():
    image = drogue.images.read(VECTORS / 'frame/demo.png')
    wanted = words_of(drogue.measure(image, DEMO, MODEL, REGION))
    wide = np.zeros((image.shape[0], 2 * image.shape[1]), np.uint8)
    wide[:, ::2] = image
    for same in (wide[:, ::2], np.asfortranarray(image), image[::-1][::-1]):
        assert words_of(drogue.measure(same, DEMO, MODEL, REGION)) == wanted


@pytest.mark.parametrize('call, error', [
    (lambda i: drogue.measure(i.astype(float), DEMO), TypeError),
    (lambda i: drogue.measure(np.zeros((2, 2, 3), np.uint8), DEMO), TypeError),
    (lambda i: drogue.measure(i[:0], DEMO), ValueError),
    (lambda i: drogue.measure(i, drogue.Camera(0, 1, 0, 0)), ValueError),
    (lambda i: drogue.measure(i, drogue.Camera(1, 1, float('nan'), 0)), ValueError),
    (lambda i: drogue.measure(i, drogue.Camera(1e6, 1, 0, 0)), ValueError),
    (lambda i: drogue.measure(i, DEMO, drogue.Model(0.1, 0.2)), ValueError),
    (lambda i: drogue.measure(i, DEMO, region=(1, 2, 3)), ValueError),
    (lambda i: drogue.measure(i, DEMO, config={'nonsense': 1}), KeyError),
    (lambda i: drogue.measure(i, DEMO, config={'min_cover': 2}), ValueError),
    (lambda i: drogue.measure(i, DEMO, config={'canny_low': 100}), ValueError),
    (lambda i: drogue.canny(i, 2, 1), ValueError),
    (lambda i: drogue.Tracker(DEMO).frame(i, 0), ValueError),
])
def test_misuse(call, error):
    with pytest.raises(error):
        call(drogue.images.read(VECTORS / 'frame/demo.png'))


def test_thresholds():
    all_of_them = drogue.thresholds()
    assert all_of_them['canny_low'].default == 30
    assert all(t.least <= t.default <= t.most and t.unit for t in all_of_them.values())


def test_the_lock_is_released():
    """Another thread runs while one frame is measured: it counts on, in steps shorter than the measurement."""
    big = np.random.default_rng(1).integers(0, 256, (2048, 2048), np.uint8)
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    drogue.canny(big, 0, 0)
    during = counted[0] - before
    done.set()
    thread.join()
    assert during > 1000
