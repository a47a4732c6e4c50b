import assert from 'node:assert/strict';
import test from 'node:test';
import { ENCLOSED_U, colourAt, scaleMarks, textureBytes, textureU } from '../../src/colours.js';
import { count, degrees, margin, millimetres, milliseconds, number, vector } from '../../src/format.js';
import { PHASES, motionAt } from '../../src/motion.js';
import { GROUPS, groupOf, sentenceOf } from '../../src/reasons.js';
import { KEYS, actionOf } from '../../src/keyboard.js';
import { LAYERS, State } from '../../src/state.js';
import { reply } from '../fixture.js';

test('lengths are millimetres, angles degrees', () => {
    assert.equal(millimetres(0.0345), '34.5 mm');
    assert.equal(degrees(Math.PI / 6), '30.0°');
    assert.equal(margin(0.002, 'm'), '2.00 mm');
    assert.equal(margin(0.1, '1'), '0.100');
    assert.equal(margin(undefined, 'm'), '–');
    assert.equal(vector([0.001, -0.002, 0], 1e3), '1.0, −2.0, 0.0');
    assert.equal(milliseconds(1500), '1.50 s');
    assert.equal(count(1234567), '1\u202f234\u202f567');
});

test('numbers that are none are said so', () => {
    assert.equal(number(null), '–');
    assert.equal(number(Infinity), '∞');
    assert.equal(number(0), '0');
    assert.equal(number(123456), '123456');
    assert.equal(number(1e-9), '0');
});

test('the colours run from blue to red, enclosed vertices apart', () => {
    const [blue, red] = [colourAt(0), colourAt(1)];
    assert.ok(blue[2] > blue[0] && red[0] > red[2]);
    const bytes = textureBytes();
    const texel = (u) => [...bytes.slice(4 * Math.floor(256 * u), 4 * Math.floor(256 * u) + 3)];
    assert.deepEqual(texel(textureU(0.02, 0.02)), red.map((v) => Math.round(255 * v)));
    assert.deepEqual(texel(textureU(0, 0.02)), blue.map((v) => Math.round(255 * v)));
    assert.equal(textureU(Infinity, 0.02), ENCLOSED_U);
    assert.notDeepEqual(texel(ENCLOSED_U), texel(textureU(0.02, 0.02)));
    assert.equal(textureU(NaN, 0.02), textureU(0, 0.02));
    assert.equal(textureU(0, 0), textureU(0, 1));
});

test('a scale has round marks up to its end', () => {
    assert.deepEqual(scaleMarks(0.021).map((m) => +m.toFixed(6)), [0, 0.01, 0.02]);
    assert.deepEqual(scaleMarks(0.4).map((m) => +m.toFixed(6)), [0, 0.1, 0.2, 0.3, 0.4]);
    assert.deepEqual(scaleMarks(0), [0]);
});

test('the motion starts before the approach, closes at the grasp and ends after the retreat', () => {
    const grasp = reply().grasps[0];
    assert.deepEqual(motionAt(0, grasp), { phase: 'approach', hand: [0, 0, 0.1], object: [0, 0, 0], closed: 0 });
    const closing = motionAt(0.5, grasp);
    assert.equal(closing.phase, 'closing');
    assert.deepEqual(closing.hand.map(Math.abs), [0, 0, 0]);
    assert.ok(Math.abs(closing.closed - 0.5) < 1e-9);
    const end = motionAt(1, grasp);
    assert.deepEqual([end.hand, end.object, end.closed], [[0, 0, 0.1], [0, 0, 0.1], 1]);
});

test('the phases follow each other without a gap', () => {
    assert.equal(PHASES[0].begin, 0);
    assert.equal(PHASES.at(-1).end, 1);
    for (let i = 1; i < PHASES.length; ++i) assert.equal(PHASES[i].begin, PHASES[i - 1].end);
});

test('every reason has a group and a sentence', () => {
    assert.equal(groupOf(''), 'ranked');
    assert.equal(groupOf('palm_hits_object'), 'collides');
    assert.equal(groupOf('axis_of_a_later_version'), 'untried');
    assert.equal(sentenceOf('approach_hits_plane'), 'The approaching hand hits the support plane.');
    assert.equal(sentenceOf('of_a_later_version'), 'of a later version');
    assert.ok(GROUPS[groupOf('slips')]);
});

test('arrow keys choose grasps and stop at both ends; space plays', () => {
    const state = new State(3);
    actionOf('ArrowUp').act(state);
    assert.equal(state.grasp, 0);
    for (let i = 0; i < 5; ++i) actionOf('ArrowDown').act(state);
    assert.equal(state.grasp, 2);
    state.set({ time: 1 });
    actionOf(' ').act(state);
    assert.deepEqual([state.playing, state.time], [true, 0]);
    assert.equal(actionOf('C').help, 'show or hide candidates');
    assert.equal(actionOf('q'), undefined);
});

test('no two things have one key', () => {
    const keys = KEYS.flatMap((entry) => entry.keys);
    assert.equal(new Set(keys).size, keys.length);
    assert.equal(Object.keys(LAYERS).length, KEYS.length - 4);
});

test('without grasps nothing is chosen and nothing plays', () => {
    const state = new State(0);
    state.step(1);
    state.togglePlay();
    assert.deepEqual([state.grasp, state.playing], [-1, false]);
});

test('choosing a grasp leaves the candidate; subscribers hear what changed', () => {
    const state = new State(2);
    const heard = [];
    state.subscribe((fields) => heard.push(fields));
    state.chooseCandidate(7);
    state.chooseGrasp(1);
    assert.deepEqual([state.candidate, heard], [-1, [['candidate'], ['grasp', 'candidate']]]);
    state.toggleReason('slips');
    assert.ok(state.hiddenReasons.has('slips'));
    state.toggleReason('slips');
    assert.ok(!state.hiddenReasons.has('slips'));
});
