// What the tests of pages share: headless Chromium, as a user has it.
import assert from 'node:assert/strict';
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import test from 'node:test';
import {pathToFileURL} from 'node:url';
import {hasProgram} from './package.mjs';

export const app = process.env.PROHULL_APP;
export const kPatience = 300000;  // milliseconds: other work may fill the machine
const kArguments = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

async function launched(name) {
  if (!existsSync(join(app, name))) return {missing: `there is no ${app}/${name}`};
  if (!hasProgram) return {missing: 'there is no program to compare with'};
  try {
    const {chromium} = createRequire(import.meta.url)('playwright-core');
    return await chromium.launch({executablePath: process.env.PROHULL_CHROMIUM, args: kArguments});
  } catch (error) {
    return {missing: error.message.split('\n')[0]};
  }
}

/** Why tests of a page are skipped, or false; what opens the page and what closes it. What must not happen is collected: errors, requests. */
export async function inBrowser(name) {
  const browser = await launched(name), file = pathToFileURL(join(app, name)).href;
  test.after(() => browser.close?.());

  async function opened({url = file, fragment = '', width = 1000, height = 700, scheme = 'light', script} = {}) {
    const page = await browser.newPage({viewport: {width, height}, colorScheme: scheme, reducedMotion: 'reduce'});
    page.setDefaultTimeout(kPatience);
    page.complaints = [];
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver Message/.test(message.text()))
        page.complaints.push(message.text());
    });
    page.on('pageerror', (error) => page.complaints.push(error.message));
    page.on('request', (request) => {
      if (!request.isNavigationRequest() && !request.url().startsWith('blob:')) page.complaints.push(`request: ${request.url()}`);
    });
    if (script) await page.addInitScript(script);
    await page.goto(url + fragment);
    await page.waitForFunction(() => document.documentElement.dataset.ready);
    return page;
  }

  async function closed(page) {
    assert.deepEqual(page.complaints, []);
    await page.close();
  }

  return {skip: browser.missing ?? false, opened, closed};
}
