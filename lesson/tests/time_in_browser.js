// Measures how long the default method takes to 1 % in the room of 1002 patches, in headless Chromium with one thread
// and the clock of the machine.
//
//   node lesson/tests/time_in_browser.js [SITE [BROWSER]]     SITE: as scripts/lesson.sh makes it
"use strict";

const { spawn } = require("child_process");
const fs = require("fs"), http = require("http"), os = require("os"), path = require("path");
const root = path.join(__dirname, "../..");
const [site = path.join(root, "build/lesson/site"), browser = "chromium"] = process.argv.slice(2);
const scene = (extension) => JSON.stringify(fs.readFileSync(path.join(root, `examples/scenes/room_1002.${extension}`), "utf8"));

const page = `<script src="hemilux.js"></script><script src="engine.js"></script><script>
(async () => {
  await hemilux.ready(loadHemilux);
  const room = new hemilux.Room(hemilux.readObj(${scene("obj")}, ${scene("mtl")})), lines = [];
  for (let seed = 1; seed <= 5; ++seed) {
    const begin = performance.now();
    const run = room.run("stored-transport", { seed });
    let steps = 0;
    do { run.step(); ++steps; } while (!(run.figures.error <= 0.01) && steps < 100);
    lines.push("seed " + seed + ": " + (100 * run.figures.error).toFixed(2) + " % after " + steps + " steps, " +
      ((performance.now() - begin) / 1000).toFixed(2) + " s");
  }
  return lines.join("\\n");
})().catch((error) => "failed: " + error.message).then((body) => fetch("told", { method: "POST", body }));
</script>`;

const server = http.createServer((request, response) => {
  if (request.method === "POST") {
    request.on("data", (told) => console.log(String(told)));
    request.on("end", () => (response.end(), opened.kill(), server.close()));
    return;
  }
  const file = path.join(site, path.basename(request.url));
  response.setHeader("content-type", request.url === "/" ? "text/html" : "text/javascript");
  response.end(request.url === "/" ? page : fs.existsSync(file) ? fs.readFileSync(file) : "");
});
let opened;
server.listen(0, "127.0.0.1", () => {
  const home = fs.mkdtempSync(path.join(os.tmpdir(), "hemilux-"));
  opened = spawn(browser, ["--headless", "--no-sandbox", "--disable-gpu", `--user-data-dir=${home}`, "--remote-debugging-port=0",
    `http://127.0.0.1:${server.address().port}/`], { stdio: "ignore", env: { ...process.env, HOME: home } });
  opened.on("exit", () => fs.rmSync(home, { recursive: true, force: true }));
});
