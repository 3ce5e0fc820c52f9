// Opens a page that has a page of `prohull view` in a frame: node embedded_test.cjs URL CHROMIUM
// With a picture that gives way to the frame when it is clicked, it is clicked first.
const assert = require('node:assert/strict');
const {withBrowser} = require('./chromium.cjs');

const [, , address, browserPath] = process.argv;

async function test(browser) {
  const page = await browser.newPage({viewport: {width: 1000, height: 800}, reducedMotion: 'reduce'});
  const complaints = [];
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('request', (request) => {
    const {origin, protocol} = new URL(request.url());
    if (origin !== new URL(address).origin && !['data:', 'about:', 'blob:'].includes(protocol))
      complaints.push(`request: ${request.url()}`);
  });
  await page.goto(address);
  const picture = page.locator('figure.live img');
  if (await picture.count() > 0) {
    assert.ok(await picture.evaluate((image) => image.complete && image.naturalWidth > 0), 'the picture is there');
    assert.equal(await page.locator('iframe').count(), 0, 'nothing is loaded before it is asked for');
    await picture.click();
  }
  const frame = await (await page.waitForSelector('iframe')).contentFrame();
  await frame.waitForFunction(() => document.documentElement?.dataset.ready, null, {timeout: 120000});
  const {colors, faces} = await frame.evaluate(async () => {
    const bitmap = await createImageBitmap(await prohullView.viewport.picture());
    const draw = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d', {willReadFrequently: true});
    draw.drawImage(bitmap, 0, 0);
    const pixels = new Uint32Array(draw.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer);
    return {colors: new Set(pixels).size, faces: document.getElementById('content').textContent};
  });
  assert.ok(colors > 50, 'the picture is not blank');
  assert.ok(faces.length > 0);
  assert.deepEqual(complaints, []);
}

withBrowser(browserPath, test);
