#!/usr/bin/env node
/** How many pictures a second a report page draws while its hand moves and its camera turns.
 *
 *    node test/frames.mjs [--graspctl FILE] OBJECT...
 *
 *  Chromium draws in software here, so a graphics card does better; "script" is our own part of a
 *  picture, which it does not speed up. Exit code 77: no Chromium here. */

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { chromiumPath, launch, openPage } from './open_page.js';

const SECONDS = 4;
const source = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../..');
const { values, positionals } = parseArgs({ allowPositionals: true, options: {
    graspctl: { type: 'string', default: path.join(source, 'build/release/src/cli/graspctl') },
} });

/** Runs in the page: counts its pictures while somebody turns the camera. */
function countPictures(milliseconds) {
    return new Promise((resolve) => {
        const start = performance.now();
        const gaps = [];
        let last = start;
        const next = (now) => {
            gaps.push(now - last);
            last = now;
            if (now - start < milliseconds) requestAnimationFrame(next);
            else resolve(gaps.slice(1).sort((a, b) => a - b));
        };
        requestAnimationFrame(next);
    });
}

async function measure(browser, file, options) {
    const { page, context } = await openPage(browser, file, options);
    await page.keyboard.press(' ');
    const client = await context.newCDPSession(page);
    await client.send('Performance.enable');
    const scriptTime = async () => {
        const { metrics } = await client.send('Performance.getMetrics');
        return metrics.find((metric) => metric.name === 'ScriptDuration').value;
    };
    await page.evaluate(countPictures, 1000); // shaders are compiled by then
    const before = await scriptTime();
    const counting = page.evaluate(countPictures, 1000 * SECONDS);
    const box = await page.locator('#canvas').boundingBox();
    await page.mouse.move(box.x + box.width / 3, box.y + box.height / 2);
    await page.mouse.down();
    for (let step = 0; step < 20; ++step) {
        await page.mouse.move(box.x + box.width / 3 + 8 * step, box.y + box.height / 2);
        await page.waitForTimeout((1000 * SECONDS) / 40);
    }
    await page.mouse.up();
    const gaps = await counting;
    const script = (1000 * ((await scriptTime()) - before)) / gaps.length;
    await context.close();
    const rate = (1000 * gaps.length) / gaps.reduce((sum, gap) => sum + gap, 0);
    return { rate, slow: gaps[Math.floor(0.95 * gaps.length)], script };
}

if (!chromiumPath()) process.exit(77);
const work = mkdtempSync(path.join(tmpdir(), 'graspd-frames-'));
const browser = await launch();
try {
    console.log('| object | faces | page [MB] | window | pictures a second | 95 % within [ms] | script [ms] |');
    console.log('| --- | --- | --- | --- | --- | --- | --- |');
    for (const object of positionals) {
        const out = path.join(work, path.basename(object));
        const json = execFileSync(values.graspctl,
            ['plan', object, '--report', out, '--format', 'json'], { maxBuffer: 1 << 28 });
        const faces = JSON.parse(json).report.stages[0].in;
        const file = path.join(out, 'report.html');
        const size = (statSync(file).size / 1e6).toFixed(1);
        for (const [name, options] of [['1400 x 900', {}], ['390 x 844', { viewport: { width: 390, height: 844 } }]]) {
            const { rate, slow, script } = await measure(browser, file, options);
            console.log(`| ${path.basename(object)} | ${faces} | ${size} | ${name} | ${rate.toFixed(0)} | `
                + `${slow.toFixed(0)} | ${script.toFixed(1)} |`);
        }
    }
} finally {
    await browser.close();
    rmSync(work, { recursive: true, force: true });
}
