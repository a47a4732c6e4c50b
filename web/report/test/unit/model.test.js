import assert from 'node:assert/strict';
import test from 'node:test';
import { decode } from '../../src/arrays.js';
import { boundsOf, candidateAt, candidatesOf, flagName, largestConcavity, readReport } from '../../src/model.js';
import { report } from '../fixture.js';

test('base64 is the bytes of little-endian numbers', () => {
    assert.deepEqual([...decode('AQAAAP////8=', Int32Array)], [1, -1]);
    assert.deepEqual([...decode('AACAPwAAAMA=', Float32Array)], [1, -2]);
    assert.deepEqual([...decode('', Float32Array)], []);
});

test('a report is read with its arrays', () => {
    const read = readReport(report());
    assert.equal(read.object.vertices.length, 24);
    assert.equal(read.object.faces.length, 36);
    assert.equal(read.candidates.count, 3);
    assert.deepEqual(read.hands[0].open[1].box.max, [-0.025, 0.01, 0.01]);
});

test('data of another schema are refused by name', () => {
    assert.throws(() => readReport(null), /graspd-report\/1.*missing/);
    assert.throws(() => readReport({ ...report(), schema: 'graspd-report/9' }), /graspd-report\/9/);
});

test('a candidate says what it came to and leaves out the rest', () => {
    const { candidates } = readReport(report());
    const wide = candidateAt(candidates, 0);
    assert.equal(wide.reason, 'axis_too_wide');
    assert.equal(wide.group, 'wide');
    assert.equal(wide.unit, 'm');
    assert.ok(Math.abs(wide.margin - 0.015) < 1e-9);
    assert.equal(wide.beta, undefined);
    const held = candidateAt(candidates, 2);
    assert.equal(held.margin, undefined);
    assert.equal(held.beta, 0);
    assert.equal(held.source, 'whole_object');
});

test('candidates are found by their reason', () => {
    const { candidates } = readReport(report());
    assert.deepEqual(candidatesOf(candidates, 'slips'), [1]);
    assert.deepEqual(candidatesOf(candidates, ''), [2]);
    assert.deepEqual(candidatesOf(candidates, 'no_such_reason'), []);
});

test('enclosed and unreferenced vertices are not the largest concavity', () => {
    assert.equal(largestConcavity([0.01, Infinity, NaN, 0.02]), 0.02);
    assert.equal(largestConcavity([]), 0);
    assert.equal(flagName(2), 'enclosed');
});

test('bounds hold all points', () => {
    const { center, radius } = boundsOf([0, 0, 0, 2, 4, 4]);
    assert.deepEqual(center, [1, 2, 2]);
    assert.equal(radius, 3);
    assert.ok(boundsOf([]).radius > 0);
});
