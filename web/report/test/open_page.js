/** Opens report pages in a headless Chromium that draws in software, and notes what goes wrong. */

import { accessSync, existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const PLACES = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser',
    '/usr/bin/google-chrome'];

/** Where Chromium is; undefined: nowhere. */
export function chromiumPath() {
    return PLACES.find((place) => place && existsSync(place));
}

export function launch(withWebGl = true) {
    const drawing = withWebGl
        ? ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']
        : ['--disable-gpu', '--disable-3d-apis'];
    return chromium.launch({ executablePath: chromiumPath(), headless: true,
        args: ['--no-sandbox', ...drawing] });
}

/** The committed page with some data in it, as write_report.cpp puts them there. */
export async function pageWith(data) {
    const template = await readFile(new URL('../dist/report_template.html', import.meta.url), 'utf8');
    return template.replace('GRASPD_REPORT_DATA', () => JSON.stringify(data).replaceAll('<', '\\u003c'));
}

/**
 * @param {import('playwright-core').Browser} browser
 * @param {string} file a page
 * @param {object} [options] of the browser's context, such as viewport and colorScheme
 * @returns the page, and lists of console errors and of requests other than for the page itself
 */
export async function openPage(browser, file, options = {}) {
    accessSync(file);
    const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, ...options });
    const page = await context.newPage();
    const address = pathToFileURL(file).href;
    const errors = [];
    const requests = [];
    page.on('console', (message) => {
        if (message.type() === 'error') errors.push(message.text());
    });
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('request', (request) => {
        if (request.url() !== address && !request.url().startsWith('data:')) requests.push(request.url());
    });
    await page.goto(address);
    await page.waitForSelector('#header h1');
    return { page, errors, requests, context };
}
