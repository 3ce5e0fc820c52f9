// Makes app.html and its service worker, and teach.html: node app.cjs PACKAGE OUT_FOLDER. Each page is one file with the library in it.
// PACKAGE is the npm package that the preset wasm has made; NODE_PATH has what package-lock.json names.
const fs = require('fs');
const path = require('path');
const zlib = require('zlib');
const {bundled, pageOf, withCode} = require('./pages.cjs');

const [packageFolder, out] = process.argv.slice(2).map((folder) => path.resolve(folder));
const inWeb = (...names) => path.join(__dirname, ...names), inPackage = (name) => path.join(packageFolder, name);

/** The package finds its module and its worker in the page. */
const inThePage = {
  name: 'in the page',
  setup(build) {
    build.onResolve({filter: /^prohull$/}, () => ({path: inPackage('index.js')}));
    build.onResolve({filter: /platform_browser\.js$/}, () => ({path: inWeb('app', 'platform.js')}));
    build.onResolve({filter: /platform_node\.js$/}, () => ({path: 'none', namespace: 'empty'}));
    build.onLoad({filter: /.*/, namespace: 'empty'}, () => ({contents: 'export {}'}));
  },
};

const DEFINED = {'import.meta.url': '"https://page.invalid/"'};  // where nothing is ever fetched from

/** What each page has of the library. */
async function libraryTexts() {
  const module = zlib.deflateSync(fs.readFileSync(inPackage('module.wasm')), {level: 9}).toString('base64');
  const worker = await bundled(inPackage('worker_browser.js'), {define: DEFINED});
  const ofArchives = fs.readFileSync(path.join(require.resolve('fflate'), '..', '..', 'LICENSE'), 'utf8');
  const licence = `${fs.readFileSync(inPackage('LICENSE'), 'utf8')}\nfflate, which reads and writes archives:\n\n${ofArchives}`;  // of all that is in it
  return {module, worker, licence};
}

async function writePage(folder, texts) {
  const script = await bundled(inWeb(folder, 'main.js'), {plugins: [inThePage], define: DEFINED});
  const style = await bundled(inWeb(folder, 'style.css'));
  const policy = {scripts: " 'wasm-unsafe-eval'", others: "worker-src 'self' blob:; "};
  const page = pageOf(withCode(fs.readFileSync(inWeb(folder, 'page.html'), 'utf8'), inWeb('..', '..')), {script, style, texts, policy});
  fs.writeFileSync(path.join(out, `${folder}.html`), page);
}

async function write() {
  fs.mkdirSync(out, {recursive: true});
  const texts = await libraryTexts();
  for (const folder of ['app', 'teach']) await writePage(folder, texts);
  fs.copyFileSync(inWeb('app', 'offline.js'), path.join(out, 'app_offline.js'));
}

write();
