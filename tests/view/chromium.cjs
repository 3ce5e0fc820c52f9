// Headless Chromium for tests; where it does not start, they are skipped with a word.
const {chromium} = require('playwright-core');

const SKIPPED = 77;
const ARGUMENTS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

async function launched(executablePath) {
  try {
    return await chromium.launch({executablePath, args: ARGUMENTS});
  } catch (error) {
    console.log(`skipped: Chromium does not start: ${error.message.split('\n')[0]}`);
    return null;
  }
}

/** Runs `test` with a browser and then ends the process: with 0, with 1 after an error, or as skipped. */
async function withBrowser(executablePath, test) {
  const browser = await launched(executablePath);
  if (!browser) {
    process.exitCode = SKIPPED;
    return;
  }
  try {
    await test(browser);
  } catch (error) {
    console.error(error);
    process.exitCode = 1;
  } finally {
    await browser.close();
  }
}

module.exports = {withBrowser};
