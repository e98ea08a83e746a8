# SPDX-License-Identifier: Apache-2.0
"""One stage of hardware against the golden vectors: mask.sv in Icarus, every pixel of every case of the stage 'mask'.

usage: python test_mask.py      (pip install cocotb; apt-get install iverilog)"""
import os
import pathlib
import sys

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge

import drogue

HERE = pathlib.Path(__file__).resolve().parent
VECTORS = pathlib.Path(os.environ.get('DROGUE_VECTORS', HERE.parents[2] / 'vectors'))


async def run(dut, params):
    """The ring as the module gives it, shape (height, width)."""
    width, height, centre2_x, centre2_y, longest = (int(v) for v in params)
    for name, value in (('width', width), ('height', height), ('centre2_x', centre2_x), ('centre2_y', centre2_y),
                        ('longest', longest), ('start', 1)):
        getattr(dut, name).value = value
    await FallingEdge(dut.clk)
    dut.start.value = 0
    ring = np.zeros(width * height, np.uint8)
    for i in range(width * height):
        assert dut.valid.value == 1, f'pixel {i} is missing'
        ring[i] = int(dut.ring.value)
        await FallingEdge(dut.clk)
    assert dut.valid.value == 0, 'more pixels than there are'
    return {'ring': ring.reshape(height, width)}


@cocotb.test()
async def every_case(dut):
    Clock(dut.clk, 10, 'ns').start()
    await FallingEdge(dut.clk)
    count = 0
    for case in drogue.vectors.load(VECTORS, stage='mask'):
        found = await run(dut, case.inputs['params'])
        for name, expected in case.exact.items():
            assert np.array_equal(found[name], expected), f'{case.id}: {name} differs'
        count += 1
    dut._log.info('mask: %d cases, every pixel as expected', count)
    assert count > 0


def main():
    from cocotb_tools.runner import get_results, get_runner
    build = pathlib.Path(os.environ.get('DROGUE_COCOTB_DIR', 'build/cocotb')).resolve()
    runner = get_runner('icarus')
    runner.build(sources=[os.environ.get('DROGUE_MASK_SV', HERE / 'mask.sv')], hdl_toplevel='mask', build_args=['-g2012'],
                 build_dir=build, timescale=('1ns', '1ns'), always=True)
    results = runner.test(hdl_toplevel='mask', test_module='test_mask', test_dir=HERE, build_dir=build,
                          results_xml=str(build / 'results.xml'))
    tests, failed = get_results(results)
    print(f'cocotb: {tests} tests, {failed} failed')
    return int(failed > 0 or tests == 0)


if __name__ == '__main__':
    sys.path.insert(0, str(HERE))
    sys.exit(main())
