/** Builds dist/report_template.html: one page that loads nothing from anywhere.
 *
 *    node build.mjs HASH     HASH: of the sources, noted in the page (scripts/report_page)
 */

import * as esbuild from 'esbuild';
import { mkdir, readFile, writeFile } from 'node:fs/promises';

const MOST_BYTES = 1.2e6;
const here = (name) => new URL(name, import.meta.url);
const text = (name) => readFile(here(name), 'utf8');

async function bundled() {
    const built = await esbuild.build({
        entryPoints: [here('src/main.js').pathname], bundle: true, minify: true, write: false,
        format: 'iife', target: 'es2022', legalComments: 'none', charset: 'utf8',
    });
    // Within the page's script element these would end or nest it.
    return built.outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
}

async function page(hash) {
    const style = await esbuild.transform(await text('src/style.css'), { loader: 'css', minify: true });
    const parts = { '/*STYLE*/': style.code.trim(), '/*SCRIPT*/': (await bundled()).trim() };
    let html = `<!-- graspd report page, sources sha256:${hash} -->\n${await text('src/index.html')}`;
    for (const [place, part] of Object.entries(parts)) html = html.replace(place, () => part);
    if (html.split('GRASPD_REPORT_DATA').length !== 2) throw new Error('the data need one place');
    if (html.length > MOST_BYTES) throw new Error(`the page has ${html.length} bytes`);
    return html;
}

const html = await page(process.argv[2]);
const { version } = JSON.parse(await text('node_modules/three/package.json'));
const licence = await text('node_modules/three/LICENSE');
await mkdir(here('dist'), { recursive: true });
await writeFile(here('dist/report_template.html'), html);
await writeFile(here('dist/LICENSES.txt'),
    `report_template.html contains three.js ${version} (npm package three):\n\n${licence}`);
console.log(`dist/report_template.html: ${html.length} bytes`);
