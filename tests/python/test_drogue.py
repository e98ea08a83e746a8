# SPDX-License-Identifier: Apache-2.0
"""The Python package against the golden vectors and the host program: the same bits, whatever the way.

DROGUE_PROGRAM names the program; without it what needs it is skipped."""
import hashlib
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import threading
import zlib

import numpy as np
import pytest

import drogue
from drogue import __main__, report

ROOT = pathlib.Path(__file__).resolve().parents[2]
VECTORS = ROOT / 'vectors'
STATUSES = ['ok', 'argument', 'region', 'workspace', 'labels_full', 'edges_full', 'arcs_full', 'no_edges', 'no_arcs',
            'no_ellipse', 'too_few_points', 'degenerate', 'no_inner_part', 'domain', 'behind_camera']
DEMO = drogue.Camera(1465.5, 1465.5, 403.5, 143.5)
MODEL = drogue.Model(0.35, 0.12, 0.25)
REGION = (152, 134, 214, 214)
WHOLE = ('canny_low', 'canny_high', 'canny_least', 'smooth', 'transfer', 'min_arc_px', 'polarity', 'refit_rounds',
         'min_inner_area_px', 'min_inner_contrast')


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
    detail += [r.cluster_members] + q(r.cover) + q(r.doubt) + [r.outside, 0 if inner is None else inner.rays]
    if r.covariance is None:
        return {'frame': frame, 'detail': detail, 'covariance': [0] * 15, 'std': [0] * 4}
    return {'frame': frame, 'detail': detail, 'covariance': q(r.covariance[np.tril_indices(5)], 48),
            'std': q(r.position_std_m, 32) + q(r.axis_std_rad, 32)}


def digest(arrays):
    sha = hashlib.sha256()
    for array in arrays:
        sha.update(np.asarray(array, np.int64).tobytes())
    return sha.hexdigest()


def thresholds_of(case):
    """What a case says of the thresholds, which come in the order of the package's table."""
    return {name: int(word) if name in WHOLE else word / 65536
            for name, word in zip(drogue.thresholds(), case.inputs.get('config', []))}


def test_every_frame_of_the_vectors_has_the_librarys_digest():
    ours, theirs, count = [], [], 0
    for case in drogue.vectors.load(VECTORS, stage='frame'):
        camera = drogue.Camera(*(case.inputs['camera'] / 65536))
        words = case.inputs['model'] / 65536
        try:
            result = drogue.measure(case.inputs['image'], camera, drogue.Model(*words), case.inputs['region'].tolist(),
                                    thresholds_of(case))
        except ValueError:
            assert STATUSES[case.exact['frame'][0]] in ('argument', 'region'), case.id
            continue  # what the package refuses before the library can
        found = words_of(result)
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


def program(*arguments, codes=(0,)):
    path = os.environ.get('DROGUE_PROGRAM')
    if path is None:
        pytest.skip('DROGUE_PROGRAM is not set')
    ended = subprocess.run([path, *map(str, arguments)], stdout=subprocess.PIPE, text=True)
    assert ended.returncode in codes
    return ended.stdout


def test_same_as_the_program():
    image = VECTORS / 'frame/demo.png'
    out = json.loads(program('measure', image, '--camera', '1465.5,1465.5,403.5,143.5', '--drogue', '0.35,0.12,0.25', '--roi',
                             '152,134,214,214', '--json', '--set', 'min_cover=0.5'))
    r = drogue.measure(drogue.images.read(image), DEMO, MODEL, REGION, {'min_cover': 0.5})
    assert np.allclose(r.pose.position_m, out['position_m'], atol=1e-6, rtol=0)
    assert np.allclose(r.covariance, out['covariance'], rtol=1e-5)
    assert (r.cover, r.outside, r.cluster_members, list(r.region)) == tuple(
        out[name] for name in ('cover', 'outside', 'cluster_members', 'region'))
    assert abs(r.log_odds - out['log_odds']) < 1e-6
    assert abs(r.pose.yaw_deg - out['yaw_deg']) < 1e-4


def test_log_odds():
    """Of what is not sure, too, and of a track; None without a pose or for a model without an inner part."""
    image = drogue.images.read(VECTORS / 'frame/demo.png')
    sure = drogue.measure(image, DEMO, MODEL, REGION).log_odds
    assert sure > 5 and q(sure)
    assert drogue.Tracker(DEMO, MODEL, REGION).frame(image).raw.log_odds == sure
    assert drogue.measure(image, DEMO, drogue.Model(0.35), REGION).log_odds is None
    assert drogue.measure(np.zeros_like(image), DEMO, MODEL).log_odds is None
    unsure = drogue.measure(drogue.images.read(VECTORS / 'frame/banded-rim-0.image.png'), DEMO, MODEL)
    assert unsure.status == 'unsure' and unsure.log_odds == unsure.cover - 3


@pytest.mark.parametrize('fps', [7, 29.97, 60, 144, 240, 700000, 1e6, 0.0005])
def test_times_of_the_program(fps, tmp_path):
    (tmp_path / 'black').write_bytes(bytes(300))
    out = program('track', tmp_path / 'black', '--raw', '1,1,gray8', '--camera', '1,1,0,0', '--fps', fps, codes=(1,))
    times = [json.loads(line)['time_s'] for line in out.splitlines()]
    assert times == [report.time_us(k, fps) / 1e6 for k in range(300)]
    assert report.time_us(240 * 600, 240) == 600 * 10**6


def test_velocities_of_the_program(tmp_path):
    """As a report takes its frames, with the time between two as the program has it."""
    image = drogue.images.read(VECTORS / 'frame/demo.png')
    frames = [np.roll(image, 2 * k, axis=1) for k in range(5)]
    rows, columns = image.shape
    (tmp_path / 'raw').write_bytes(b''.join(f.tobytes() for f in frames))
    out = program('track', tmp_path / 'raw', '--raw', f'{columns},{rows},gray8', '--camera', '1465.5,1465.5,403.5,143.5',
                  '--drogue', '0.35,0.12,0.25', '--fps', '60')
    tracker = drogue.Tracker(DEMO, MODEL)
    for k, line in enumerate(out.splitlines()):
        estimate = tracker.frame(frames[k], (report.time_us(k, 60) - report.time_us(k - 1, 60)) / 1e6).filtered
        assert np.allclose(estimate.velocity_mps, json.loads(line)['filtered']['velocity_mps'], atol=1e-6, rtol=0)


def png(path, samples):
    """A PNG of 16 bits; samples of shape (rows, columns, channels)."""
    rows, columns, channels = samples.shape
    lines = b''.join(b'\0' + row.astype('>u2').tobytes() for row in samples)

    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

    head = struct.pack('>IIBBBBB', columns, rows, 16, {1: 0, 2: 4, 3: 2, 4: 6}[channels], 0, 0, 0)
    chunks = chunk(b'IHDR', head) + chunk(b'IDAT', zlib.compress(lines)) + chunk(b'IEND', b'')
    path.write_bytes(b'\x89PNG\r\n\x1a\n' + chunks)
    return path


@pytest.mark.parametrize('channels', [1, 2, 3, 4])
def test_sixteen_bits_are_those_of_the_program(channels, tmp_path):
    """Grey by Pillow; with colour or alpha by OpenCV, and without that refused, not cut down."""
    grey = drogue.images.read(VECTORS / 'frame/demo.png').astype(np.uint32)
    path = png(tmp_path / 'wide.png', np.minimum(257 * grey + 200, 65535)[..., None].repeat(channels, axis=2))
    if channels > 1:
        with pytest.MonkeyPatch.context() as patch:
            patch.setitem(sys.modules, 'cv2', None)
            with pytest.raises(ImportError, match='wide.png: 16 bits .* need OpenCV'):
                drogue.images.read(path)
        pytest.importorskip('cv2')
    found = drogue.images.read(path)
    assert np.array_equal(found, (np.minimum(257 * grey + 200, 65535) * 255 + 32767) // 65535)
    program('edges', path, tmp_path / 'edges.png', '--low', 40, '--high', 100)
    assert np.array_equal(drogue.canny(found, 40, 100), drogue.images.read(tmp_path / 'edges.png'))


@pytest.mark.parametrize('kind', [5, 6])
@pytest.mark.parametrize('most', [1, 100, 254, 255, 1000, 4095, 65535])
def test_pnm_of_any_greatest_value_is_the_programs(kind, most, tmp_path):
    samples = np.random.default_rng(most).integers(0, most + 1, (48, 60, 3 if kind == 6 else 1))
    path = tmp_path / 'image.pnm'
    path.write_bytes(b'P%d # of it\n60 48\n%d\n' % (kind, most) + samples.astype('>u2' if most > 255 else 'u1').tobytes())
    found = drogue.images.read(path)
    eight = ((samples * 510 + most) // (2 * most)).astype(np.uint8)
    assert np.array_equal(found, eight[..., 0] if kind == 5 else drogue.images.to_grey(eight))
    program('edges', path, tmp_path / 'edges.png', '--low', 40, '--high', 100)
    assert np.array_equal(drogue.canny(found, 40, 100), drogue.images.read(tmp_path / 'edges.png'))


@pytest.mark.parametrize('data, said', [
    (b'P5 2 2 255 abc', 'the file ends early'),
    (b'P5 2 2 100 abce', 'a sample is 101, more than the 100 that the header allows'),
    (b'P6 2 2 0 abcd', 'no sound header'),
    (b'P5 2 # no end', 'no sound header'),
    (b'P5 99999 99999 255 ', 'are more than the 67108864 that are read'),
])
def test_pnm_is_refused_as_by_the_program(data, said, tmp_path):
    path = tmp_path / 'image.pgm'
    path.write_bytes(data)
    with pytest.raises(ValueError, match=f'^{re.escape(str(path))}: .*{said}'):
        drogue.images.read(path)
    program('edges', path, tmp_path / 'edges.png', '--low', 40, '--high', 100, codes=(2,))


def page(*arguments):
    return __main__.main(['report', '--camera', '1465.5,1465.5,403.5,143.5', *map(str, arguments)])


def test_a_report_on_too_large_an_image_is_one_line(tmp_path, capsys):
    large = tmp_path / 'large.pgm'
    large.write_bytes(b'P5 20000 20000 255 ')
    assert page(large, '-o', tmp_path / 'page.html') == 2
    error = capsys.readouterr().err
    assert error.startswith(f'drogue: {large}: ') and error.count('\n') == 1, error


def test_a_report_never_writes_over_its_input(tmp_path, capsys):
    demo = (VECTORS / 'frame/demo.png').read_bytes()
    (tmp_path / 'g8.png').write_bytes(demo)
    for frames in (tmp_path, tmp_path / 'g8.png'):
        assert page(frames, '-o', tmp_path / 'g8.png') == 2
        assert capsys.readouterr().err == f'drogue: {tmp_path}/g8.png: is read as input and would be overwritten\n'
    assert (tmp_path / 'g8.png').read_bytes() == demo


@pytest.mark.parametrize('arguments, said', [
    (['--fps', '0.0001'], '--fps'),
    (['--fps', '1e-9'], '--fps'),
    (['--fps', 'inf'], '--fps'),
    (['--fps', 'nan'], '--fps'),
    (['--fps', '1000001'], '--fps'),
    (['--distortion', '300,0,0,0,0'], 'beyond 256'),
    (['--drogue', '1e-9'], 'radius must be at least 0.01'),
    (['--drogue', '0.005,0.002,0.003'], 'radius must be at least 0.01'),
    (['--drogue', '0.35,0,0.25'], 'INNER must be above 0'),
    (['--drogue', '0.35,1e-7,0.25'], 'INNER must be above 0'),
    (['--camera', '1465.5,1465.5,5000,143.5'], 'the principal point lies far outside the image'),
    (['--roi', '1,2,3,0'], 'greater than 0'),
    (['--roi', '1,2,8193,4'], '8192'),
    ([VECTORS / 'smooth/ramp.image.png'], 'ramp.image.png: 52x20 pixels, unlike the first frame\'s 640x480'),
])
def test_a_report_refuses_what_the_program_does(arguments, said, tmp_path, capsys):
    assert page(VECTORS / 'frame/demo.png', *arguments, '-o', tmp_path / 'page.html') == 2
    error = capsys.readouterr().err
    assert error.startswith('drogue: ') and error.count('\n') == 1 and said in error, error
    assert not (tmp_path / 'page.html').exists()


def test_a_report_takes_values_below_zero(tmp_path):
    """Behind an option as well as joined to it, which is all that argparse takes."""
    demo = VECTORS / 'frame/demo.png'
    pages = []
    for lens, region in ((['--distortion', '-0.1,0.01,0,0,0'], ['--roi', '-10,134,214,214']),
                         (['--distortion=-0.1,0.01,0,0,0'], ['--roi=-10,134,214,214']),
                         (['--dist', '-.1,0.01,0,0,0'], ['--roi', '-1e1,134,214,214'])):
        parsed = __main__.parse(['report', str(demo), '-o', 'page.html', '--camera', '1,1,0,0', *lens, *region])
        pages.append((parsed.distortion, parsed.roi, parsed.frames))
    assert pages == 3 * [([-0.1, 0.01, 0, 0, 0], [-10, 134, 214, 214], [str(demo)])]
    assert __main__.joined(['--version', '--', '--roi', '-1']) == ['--version', '--', '--roi', '-1']
    assert page(demo, '-o', tmp_path / 'page.html', '--distortion', '-0.1,0.01,0,0,0', '--roi', '-10,134,514,214') == 0
    assert (tmp_path / 'page.html').stat().st_size > 100000


@pytest.mark.parametrize('arguments, said', [
    (['--camera', '1,2,3,abc'], "argument --camera: 'abc' is not a decimal number"),
    (['--camera', '1,2,3,nan'], "argument --camera: 'nan' is not a decimal number"),
    (['--distortion', '-0.1;0'], 'argument --distortion: 5 numbers separated by commas are wanted, not 1'),
    (['--drogue', '0.35,,0.25'], "argument --drogue: '' is not a decimal number"),
    (['--roi', '1,2,x,4'], "argument --roi: 'x' is not a decimal number"),
])
def test_a_report_says_what_is_no_number(arguments, said, tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        page(VECTORS / 'frame/demo.png', '-o', tmp_path / 'page.html', *arguments)
    assert ended.value.code == 2 and said in capsys.readouterr().err


@pytest.mark.parametrize('arguments, said', [
    (['--set', 'min_cover'], "--set: 'min_cover' is not NAME=VALUE"),
    (['--set', 'nonsense=1'], "--set: no threshold is named 'nonsense'"),
    (['--set', 'min_cover=2'], "--set: min_cover: '2' is outside [0, 1]"),
    (['--set', 'min_cover=-0.1'], "--set: min_cover: '-0.1' is outside [0, 1]"),
    (['--set', 'min_cover=x'], "--set: min_cover: 'x' is not a decimal number"),
    (['--max-missed', '-1'], "--max-missed: '-1' is outside [0, 1000000]"),
    (['--max-missed', '1.5'], "--max-missed: '1.5' is not a whole number"),
    (['--min-reliability', 'x'], "--min-reliability: 'x' is not a decimal number"),
    (['--min-reliability', '1.5'], 'min_reliability is from 0 to 1'),
    (['--set', 'smooth=0.5'], 'smooth must be a whole number'),
    (['--set', 'canny_low=200'], 'thresholds contradict each other'),
])
def test_a_report_refuses_settings_as_the_program_does(arguments, said, tmp_path, capsys):
    demo, camera = VECTORS / 'frame/demo.png', '1465.5,1465.5,403.5,143.5'
    program('track', demo, '--camera', camera, *arguments, codes=(2,))
    try:
        code = page(demo, '-o', tmp_path / 'page.html', *arguments)
    except SystemExit as ended:
        code = ended.code
    error = capsys.readouterr().err
    assert code == 2 and said in error and not (tmp_path / 'page.html').exists(), error


def rows_of(path):
    return json.loads(re.search(r'const rows = (\[.*\])', path.read_text())[1])


def test_a_report_takes_settings_as_the_program_does(tmp_path):
    """Distance by another transfer; a track that survives no frame; a measurement that is not reliable enough."""
    demo, camera, out = VECTORS / 'frame/demo.png', '1465.5,1465.5,403.5,143.5', tmp_path / 'page.html'
    black = tmp_path / 'black.pgm'
    black.write_bytes(b'P5 640 480 255 ' + bytes(640 * 480))
    for given in ([], ['--set', 'transfer=1'], ['--set', 'transfer=1', '--set', 'transfer=0', '--set', 'min_cover=0.5'],
                  ['--min-reliability', '1'], ['--max-missed', '0']):
        lines = program('track', demo, black, '--camera', camera, *given, codes=(0, 1)).splitlines()
        assert page(demo, black, '-o', out, *given) == 0
        rows = rows_of(out)
        assert [r['state'] for r in rows] == [json.loads(line)['state'] for line in lines]
        for found, line in zip(rows, map(json.loads, lines)):
            if line['filtered'] is not None:
                assert np.allclose([found[k] for k in 'xyz'], line['filtered']['position_m'], atol=1e-5, rtol=0), given


@pytest.mark.parametrize('bytes_of, reason', [
    (lambda png: png[:2000], 'image file is truncated'),
    (lambda png: png[:8], 'cannot be read as an image'),
    (lambda png: png[:40] + b'\0' * 40 + png[80:], ''),
    (lambda png: b'', 'cannot be read as an image'),
    (lambda png: None, 'No such file or directory'),
])
def test_a_report_names_the_picture_that_it_cannot_read(bytes_of, reason, tmp_path, capsys):
    broken, data = tmp_path / 'broken.png', bytes_of((VECTORS / 'frame/demo.png').read_bytes())
    if data is not None:
        broken.write_bytes(data)
    assert page(VECTORS / 'frame/demo.png', broken, '-o', tmp_path / 'page.html') == 2
    error = capsys.readouterr().err
    assert error.startswith(f'drogue: {broken}: {reason}') and error.count('\n') == 1, error
    assert len(error) > len(f'drogue: {broken}: \n')


@pytest.mark.parametrize('output, said', [
    ('nodir/page.html', 'there is no folder'),
    ('.', 'is a folder'),
])
def test_a_report_that_cannot_be_written_computes_nothing(output, said, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(report, 'build', lambda *_: pytest.fail('computed'))
    assert page(VECTORS / 'frame/demo.png', '-o', tmp_path / output) == 2
    error = capsys.readouterr().err
    assert error.startswith(f'drogue: {tmp_path / output}: {said}') and error.count('\n') == 1, error


@pytest.mark.parametrize('region', ['inf,1,2,3', '1,2,3.9,4', '1,2,nan,4', '1,2,3'])
def test_a_report_takes_whole_numbers_for_a_region(region, tmp_path, capsys):
    with pytest.raises(SystemExit) as ended:
        page(VECTORS / 'frame/demo.png', '-o', tmp_path / 'page.html', '--roi', region)
    assert ended.value.code == 2 and '--roi' in capsys.readouterr().err


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
    most = re.search(r'#define DROGUE_SEARCH_MAX (\d+)', (ROOT / 'include/drogue/search.h').read_text())[1]
    assert f'at most {most}.' in drogue.search.__doc__
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
    (lambda i: drogue.measure(i, drogue.Camera(1465.5, 14.655, 0, 0)), ValueError),
    (lambda i: drogue.measure(i, drogue.Camera(1, 1, 0, 0, k1=300)), ValueError),
    (lambda i: drogue.measure(i, drogue.Camera(1, 1, 5000, 0)), ValueError),
    (lambda i: drogue.Tracker(drogue.Camera(1, 1, 0, -4500)).frame(i), ValueError),
    (lambda i: drogue.measure(i, DEMO, drogue.Model(0.1, 0.2)), ValueError),
    (lambda i: drogue.measure(i, DEMO, drogue.Model(0.005)), ValueError),
    (lambda i: drogue.measure(i, DEMO, region=(1, 2, 3)), ValueError),
    (lambda i: drogue.measure(i, DEMO, config={'nonsense': 1}), KeyError),
    (lambda i: drogue.measure(i, DEMO, config={'min_cover': 2}), ValueError),
    (lambda i: drogue.measure(i, DEMO, config={'canny_low': 100}), ValueError),
    (lambda i: drogue.measure(i, drogue.Camera(None, 1, 0, 0)), TypeError),
    (lambda i: drogue.measure(i, drogue.Camera('1', 1, 0, 0)), TypeError),
    (lambda i: drogue.measure(i, drogue.Camera(10**400, 1, 0, 0)), ValueError),
    (lambda i: drogue.measure(i, DEMO, drogue.Model('1')), TypeError),
    (lambda i: drogue.measure(i, DEMO, region=(152.0, 134.0, 214.0, 214.0)), TypeError),
    (lambda i: drogue.measure(i, DEMO, region='1234'), TypeError),
    (lambda i: drogue.measure(i, DEMO, region=(10**30, 0, 1, 1)), ValueError),
    (lambda i: drogue.measure(i, DEMO, config={1: 1}), KeyError),
    (lambda i: drogue.measure(i, DEMO, config={'min_cover': 'x'}), TypeError),
    (lambda i: drogue.measure(i, DEMO, config={'min_cover': None}), TypeError),
    (lambda i: drogue.canny(i, 2, 1), ValueError),
    (lambda i: drogue.Tracker(DEMO).frame(i, 0), ValueError),
    (lambda i: drogue.Tracker(DEMO).frame(i, 1e9), ValueError),
    (lambda i: drogue.Tracker(DEMO).frame(i, float('inf')), ValueError),
    (lambda i: drogue.Tracker(DEMO, region=(0, 0, 0, 9)), ValueError),
])
def test_misuse(call, error):
    with pytest.raises(error):
        call(drogue.images.read(VECTORS / 'frame/demo.png'))


def test_a_refusal_says_what_is_wrong():
    image = np.zeros((9, 9), np.uint8)
    with pytest.raises(TypeError, match='^fx must be a number$'):
        drogue.measure(image, drogue.Camera(None, 1, 0, 0))
    with pytest.raises(TypeError, match='^min_cover must be a number$'):
        drogue.measure(image, DEMO, config={'min_cover': 'x'})
    with pytest.raises(TypeError, match='of a region must be whole numbers$'):
        drogue.measure(image, DEMO, region=(1, 2, 3.0, 4))
    drogue.measure(image, DEMO, region=np.array([1, 2, 3, 4]))  # whole numbers of numpy's are
    for no_image in (None, 'demo.png', [[1, 2], [3, 4]], image.astype(float)):
        for call in (lambda i: drogue.measure(i, DEMO), drogue.search, drogue.Tracker(DEMO).frame,
                     lambda i: drogue.canny(i, 1, 2)):
            with pytest.raises(TypeError, match='^the image must be a two-dimensional numpy array of uint8'):
                call(no_image)
    with pytest.raises(TypeError, match='^low and high must be whole numbers$'):
        drogue.canny(image, 1.5, 2)
    with pytest.raises(ValueError, match='^low and high are outside'):
        drogue.canny(image, 1, 2**40)
    with pytest.raises(TypeError, match='^max_missed must be a whole number$'):
        drogue.Tracker(DEMO, max_missed=1.5)
    with pytest.raises(ValueError, match='^max_missed is outside'):
        drogue.Tracker(DEMO, max_missed=-1)
    with pytest.raises(TypeError, match='^min_reliability must be a number$'):
        drogue.Tracker(DEMO, min_reliability='1')
    with pytest.raises(TypeError, match='^the time between frames must be a number$'):
        drogue.Tracker(DEMO).frame(image, 'x')


def test_a_stage_without_cases_is_refused():
    assert len(list(drogue.vectors.load(VECTORS, stage='mask'))) > 0
    with pytest.raises(ValueError, match="no case of a stage 'masks'"):
        next(drogue.vectors.load(VECTORS, stage='masks'))


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
