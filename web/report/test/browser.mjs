#!/usr/bin/env node
/** Opens report pages as a person would and looks at what they show.
 *
 *    node test/browser.mjs [--graspctl FILE] [--pictures DIR] [OBJECT...]
 *
 *  Plans every object (default: the ones under examples/objects) with graspctl, opens the page and
 *  clicks through it; then pages of odd data. Exit code 77: no Chromium here. */

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { report } from './fixture.js';
import { chromiumPath, launch, openPage, pageWith } from './open_page.js';

const source = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../..');
const { values, positionals } = parseArgs({ allowPositionals: true, options: {
    graspctl: { type: 'string', default: path.join(source, 'build/release/src/cli/graspctl') },
    pictures: { type: 'string' },
} });
const work = mkdtempSync(path.join(tmpdir(), 'graspd-report-'));
const PHONE = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true };

const text = (page, selector) => page.locator(selector).innerText();
const state = (page, field) => page.evaluate((name) => window.graspdReport.state[name], field);
const drawn = (page) => page.waitForTimeout(700); // software drawing takes its time

/** Whether the canvas shows more than its background. */
async function showsSomething(page) {
    const shot = await page.locator('#canvas').screenshot();
    return shot.length > 8000; // an empty picture packs to less
}

async function checkTables(page, reply) {
    assert.equal(await page.locator('#grasps li').count(), reply.grasps.length);
    assert.match(await text(page, '#header'), new RegExp(reply.status));
    const reasons = await page.locator('#reasons tr').count();
    assert.equal(reasons, 1 + Object.keys(reply.report.rejections).length);
    const stages = await page.locator('#stages details tbody tr').count();
    assert.equal(stages, reply.report.stages.length);
    assert.match(await text(page, '#request'), new RegExp(reply.planner.config_hash));
    const terms = await page.locator('#details svg rect').count();
    assert.equal(terms, Object.keys(reply.grasps[0].terms).length);
}

async function checkKeys(page, grasps) {
    await page.keyboard.press('ArrowDown');
    assert.equal(await state(page, 'grasp'), Math.min(1, grasps - 1));
    assert.match(await text(page, '#details h2'), new RegExp(`#${Math.min(2, grasps)}`));
    await page.keyboard.press('Home');
    await page.keyboard.press('?');
    assert.ok(await page.locator('#help').isVisible());
    await page.keyboard.press('Escape');
    assert.ok(!(await page.locator('#help').isVisible()));
    await page.keyboard.press(' ');
    await page.waitForFunction(() => window.graspdReport.state.time > 0.65);
    await page.keyboard.press(' ');
    assert.equal(await state(page, 'playing'), false);
}

async function checkLayers(page) {
    for (const button of await page.locator('#layers button').all()) {
        const before = await button.getAttribute('aria-pressed');
        await button.click();
        assert.notEqual(await button.getAttribute('aria-pressed'), before);
        await button.click();
    }
}

/** A click on a reason shows a candidate that fell by it, in the picture too. */
async function checkCandidates(page, reply) {
    const [reason] = Object.keys(reply.report.rejections);
    await page.locator('#reasons button.reason', { hasText: reason }).first().click();
    assert.match(await text(page, '#details'), new RegExp(reason));
    await page.keyboard.press('Escape');
    assert.equal(await state(page, 'candidate'), -1);

    await page.locator('#layers button', { hasText: 'candidates' }).click();
    await drawn(page);
    await page.evaluate(() => window.graspdReport.picture.choose(0));
    assert.match(await text(page, '#details h2'), /Candidate 1/);
    await page.keyboard.press('Escape');
}

async function checkObject(browser, file) {
    const folder = path.join(work, path.basename(file));
    execFileSync(values.graspctl, ['plan', file, '--report', folder, '--up', '0,0,1'],
        { stdio: ['ignore', 'ignore', 'inherit'] });
    const reply = JSON.parse(readFileSync(path.join(folder, 'reply.json'), 'utf8'));
    const html = path.join(folder, 'report.html');
    for (const [name, options] of [['desktop', {}], ['phone', { ...PHONE, colorScheme: 'dark' }]]) {
        const { page, errors, requests, context } = await openPage(browser, html, options);
        await drawn(page);
        assert.equal(await page.getAttribute('#view', 'data-ready'), 'true');
        assert.ok(await showsSomething(page), 'the picture is empty');
        await checkTables(page, reply);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(wide <= 0, `the page is ${wide} pixels too wide`);
        await save(page, `${path.basename(file)}_${name}`);
        if (name === 'desktop') {
            await checkKeys(page, reply.grasps.length);
            await checkLayers(page);
            await checkCandidates(page, reply);
            await save(page, `${path.basename(file)}_candidates`);
        }
        assert.deepEqual(errors, []);
        assert.deepEqual(requests, []);
        await context.close();
    }
}

async function save(page, name) {
    if (!values.pictures) return;
    mkdirSync(values.pictures, { recursive: true });
    await drawn(page);
    await page.screenshot({ path: path.join(values.pictures, `${name}.png`) });
}

async function openData(browser, data, options) {
    const file = path.join(work, 'odd.html');
    writeFileSync(file, await pageWith(data));
    return openPage(browser, file, options);
}

/** Markup in names stays text. */
async function checkOddNames(browser) {
    const data = report();
    const odd = '</script><img src=x onerror="window.hacked=1"><b>&amp;"\'';
    data.file = data.reply.request_id = odd;
    data.reply.report.findings[0].detail = odd;
    data.reply.report.rejections[odd] = 1;
    const { page, errors, requests, context } = await openData(browser, data);
    await drawn(page);
    assert.equal(await text(page, '#header h1'), odd);
    assert.equal(await page.locator('img').count(), 0);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.deepEqual([errors, requests], [[], []]);
    await context.close();
}

/** Without a grasp the page says why; a refused request has no object. */
async function checkNoGrasp(browser) {
    const data = report();
    data.reply = { ...data.reply, status: 'NO_GRASP', message: 'none of 2 candidates holds', grasps: [] };
    data.hands = [];
    const none = await openData(browser, data);
    await drawn(none.page);
    assert.match(await text(none.page, '#details'), /none of 2 candidates holds/);
    await none.page.keyboard.press('ArrowDown');
    await none.page.keyboard.press(' ');
    assert.deepEqual(none.errors, []);
    await none.context.close();

    data.reply.status = 'INVALID_REQUEST';
    data.object = { ...data.object, vertices: '', faces: '', concavity: '', flags: '', hull: '' };
    const refused = await openData(browser, data);
    assert.match(await text(refused.page, '#no-picture'), /refused/);
    assert.deepEqual(refused.errors, []);
    await refused.context.close();

    const broken = await openData(browser, { schema: 'other/1' });
    assert.match(await text(broken.page, '#header'), /cannot be read.*other\/1/s);
    await broken.context.close();
}

/** A click in the picture on the place of a candidate chooses it. */
async function checkPicking(browser) {
    const data = report();
    const { page, context } = await openData(browser, data);
    await page.keyboard.press('c');
    await page.keyboard.press('o');
    await drawn(page);
    const place = await page.evaluate(() => {
        const { picture } = window.graspdReport;
        const box = picture.stage.canvas.getBoundingClientRect();
        // The bar of the axis that is too wide runs along x; its end sticks out of everything else.
        const point = picture.stage.camera.position.clone().set(0.048, 0, 0);
        point.project(picture.stage.camera);
        return [box.left + ((point.x + 1) / 2) * box.width, box.top + ((1 - point.y) / 2) * box.height];
    });
    await page.mouse.click(...place);
    assert.match(await text(page, '#details'), /axis_too_wide/);
    assert.match(await text(page, '#details'), /15\.0 mm/);
    await context.close();
}

async function checkWithoutWebGl() {
    const browser = await launch(false);
    const { page, errors } = await openData(browser, report());
    assert.ok(await page.locator('#no-picture').isVisible());
    assert.match(await text(page, '#no-picture'), /WebGL/);
    assert.match(await text(page, '#details'), /Grasp #1/);
    // three.js itself says on the console that it got no context; nothing else may be said.
    assert.deepEqual(errors.filter((error) => !error.includes('WebGL')), []);
    await browser.close();
}

async function main() {
    if (!chromiumPath()) {
        console.log('no Chromium here (Debian: chromium): the pages are not opened');
        process.exitCode = 77;
        return;
    }
    const folder = path.join(source, 'examples/objects');
    const shipped = readdirSync(folder).filter((name) => /\.(ply|obj|stl|off|pcd)$/.test(name))
        .map((name) => path.join(folder, name));
    const browser = await launch();
    const checks = [checkOddNames, checkNoGrasp, checkPicking, checkWithoutWebGl,
        ...(positionals.length > 0 ? positionals : shipped).map((file) => {
            const check = (b) => checkObject(b, file);
            Object.defineProperty(check, 'name', { value: path.basename(file) });
            return check;
        })];
    let failed = 0;
    for (const check of checks) {
        try {
            await check(browser);
            console.log(`ok ${check.name}`);
        } catch (error) {
            ++failed;
            console.log(`not ok ${check.name}\n${error.stack}`);
        }
    }
    await browser.close();
    rmSync(work, { recursive: true });
    console.log(`${checks.length - failed} passed, ${failed} failed`);
    process.exitCode = failed > 0 ? 1 : 0;
}

await main();
