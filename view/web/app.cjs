// Makes app.html, one file with the library in it, and its service worker: node app.cjs PACKAGE OUT_FOLDER
// PACKAGE is the npm package that the preset wasm has made; NODE_PATH has what package-lock.json names.
const fs = require('fs');
const path = require('path');
const zlib = require('zlib');
const {bundled, pageOf} = require('./pages.cjs');

const [packageFolder, out] = process.argv.slice(2).map((folder) => path.resolve(folder));
const app = path.join(__dirname, 'app'), inPackage = (name) => path.join(packageFolder, name);

/** The package finds its module and its worker in the page. */
const inThePage = {
  name: 'in the page',
  setup(build) {
    build.onResolve({filter: /^prohull$/}, () => ({path: inPackage('index.js')}));
    build.onResolve({filter: /platform_browser\.js$/}, () => ({path: path.join(app, 'platform.js')}));
    build.onResolve({filter: /platform_node\.js$/}, () => ({path: 'none', namespace: 'empty'}));
    build.onLoad({filter: /.*/, namespace: 'empty'}, () => ({contents: 'export {}'}));
  },
};

const DEFINED = {'import.meta.url': '"https://page.invalid/"'};  // where nothing is ever fetched from

async function write() {
  const script = await bundled(path.join(app, 'main.js'), {plugins: [inThePage], define: DEFINED});
  const style = await bundled(path.join(app, 'style.css'));
  const worker = await bundled(inPackage('worker_browser.js'), {define: DEFINED});
  const policy = {scripts: " 'wasm-unsafe-eval'", others: "worker-src 'self' blob:; "};
  const module = zlib.deflateSync(fs.readFileSync(inPackage('module.wasm')), {level: 9}).toString('base64');
  const licence = fs.readFileSync(inPackage('LICENSE'), 'utf8');  // of all that is compiled in
  fs.mkdirSync(out, {recursive: true});
  fs.writeFileSync(path.join(out, 'app.html'),
      pageOf(path.join(app, 'page.html'), {script, style, policy},
      {'<!--module-->': module, '<!--worker-->': worker, '<!--licence-->': licence}));
  fs.copyFileSync(path.join(app, 'offline.js'), path.join(out, 'app_offline.js'));
}

write();
