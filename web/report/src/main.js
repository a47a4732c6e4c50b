/** Puts the page together. */

import { fill, mount } from './dom.js';
import { KEYS, listen } from './keyboard.js';
import { readReport } from './model.js';
import { details } from './panel/details.js';
import { findingsTree, funnelTree, headerTree, requestTree, stagesTree } from './panel/facts.js';
import { balancePlot, groupLegend, reasonTable } from './panel/fallen.js';
import { graspList } from './panel/grasps.js';
import { layerButtons, scaleTree } from './panel/layers.js';
import { playback } from './panel/playback.js';
import { State } from './state.js';
import { Picture } from './view/picture.js';

const at = (id) => document.getElementById(id);

function showTables(data, report, state) {
    document.title = `${data.file || report.reply.request_id}: grasps`;
    fill(at('header'), ...headerTree(report, data.file));
    graspList(at('grasps'), report.reply, state);
    details(at('details'), report, state);
    reasonTable(at('reasons'), report, state);
    balancePlot(at('balance'), report, state);
    at('balance').after(mount(groupLegend(report)));
    fill(at('funnel'), funnelTree(report.reply));
    fill(at('stages'), ...stagesTree(report.reply));
    fill(at('findings'), ...findingsTree(report.reply));
    fill(at('request'), requestTree(report));
    layerButtons(at('layers'), state);
    fill(at('scale'), scaleTree(report.object));
    playback({ button: at('play'), slider: at('time'), phase: at('phase') }, state);
}

function showHelp(state) {
    const rows = KEYS.map(({ shown, help }) =>
        ['tr', {}, ['td', {}, ['kbd', {}, shown]], ['td', {}, help]]);
    const other = [['?', 'this help'], ['Esc', 'back from a candidate to the grasp']].map(
        ([key, help]) => ['tr', {}, ['td', {}, ['kbd', {}, key]], ['td', {}, help]]);
    fill(at('keys'), ['tbody', {}, rows, other]);
    at('help-button').addEventListener('click', () => at('help').showModal());
    listen(state, at('help'));
}

function showPicture(report, state) {
    if (report.object.faces.length === 0) {
        at('no-picture').textContent = 'There is no object to draw: the request was refused before.';
        at('no-picture').hidden = false;
        return;
    }
    try {
        const picture = new Picture(at('canvas'), report, state);
        at('home').addEventListener('click', () => picture.stage.home());
        at('view').dataset.ready = 'true';
        window.graspdReport = { state, picture }; // for tests and for the curious
    } catch (error) {
        console.info('no 3-D picture:', error.message);
        at('no-picture').hidden = false;
        at('view').dataset.ready = 'false';
    }
}

function start() {
    try {
        const data = JSON.parse(at('graspd-data').textContent);
        const report = readReport(data);
        const state = new State(report.reply.grasps.length);
        showTables(data, report, state);
        showHelp(state);
        showPicture(report, state);
    } catch (error) {
        fill(at('header'), ['h1', {}, 'This report cannot be read'], ['span', {}, error.message]);
        document.body.classList.add('broken');
    }
}

start();
