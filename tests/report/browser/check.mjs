// Opens a report in headless Chromium and looks whether it does what it says. By hand:
//   npm ci && node check.mjs OUT/report.html [FOLDER for pictures]
// SPDX-License-Identifier: Apache-2.0
import puppeteer from "puppeteer-core";
import { pathToFileURL } from "node:url";

const [report, pictures] = process.argv.slice(2);
const address = pathToFileURL(report).href;
let faults = 0;
function expect(name, holds, found = "") {
  console.log((holds ? "ok    " : "FAULT ") + name + (found === "" ? "" : ": " + found));
  faults += holds ? 0 : 1;
}

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
    "--host-resolver-rules=MAP * ~NOTFOUND"],
  protocolTimeout: 600000,
});

async function open(viewport, scheme) {
  const page = await browser.newPage();
  const seen = { requests: [], errors: [] };
  page.on("request", (request) => seen.requests.push(request.url()));
  page.on("console", (message) => {
    if (message.type() === "error") seen.errors.push(message.text());
  });
  page.on("pageerror", (error) => seen.errors.push(String(error)));
  await page.setViewport(viewport);
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
  const start = Date.now();
  await page.goto(address, { waitUntil: "load", timeout: 300000 });
  await page.waitForFunction(() => document.documentElement.dataset.ready, { timeout: 60000 });
  if (await page.$("#model")) {
    await page.waitForFunction(() => document.documentElement.dataset.model, { timeout: 300000 });
  }
  seen.seconds = (Date.now() - start) / 1000;
  return { page, seen };
}

async function picture(page, name, options = {}) {
  if (pictures) await page.screenshot({ path: `${pictures}/${name}.png`, ...options });
}

// A desk.
{
  const { page, seen } = await open({ width: 1280, height: 900 }, "light");
  console.log("      ready after " + seen.seconds.toFixed(1) + " s");
  const elsewhere = seen.requests.filter(
    (url) => url !== address && !url.startsWith("blob:") && !url.startsWith("data:"));
  expect("nothing leaves the page", elsewhere.length === 0, elsewhere.join(" "));
  expect("no errors", seen.errors.length === 0, seen.errors.join(" | "));
  await picture(page, "desk");
  const plan = await page.$(".plan");
  if (plan && pictures) await plan.screenshot({ path: `${pictures}/plan.png` });
  const wipe = await page.$(".frame input");
  if (wipe) {
    await wipe.scrollIntoView();
    const at = () => page.$eval(".wipe", (element) => element.style.getPropertyValue("--at"));
    const box = await wipe.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2, { steps: 5 });
    await page.mouse.up();
    expect("a wipe follows the mouse", parseFloat(await at()) < 35, await at());
    await picture(page, "wipe");
    const before = parseFloat(await at());
    await wipe.focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
    expect("and the arrow keys", parseFloat(await at()) === before + 5, await at());
    const enlarged = await page.$('.wipe option[value="residuals"]');
    if (enlarged) {
      const display = () => page.$eval(".residuals", (element) => getComputedStyle(element).display);
      expect("residuals are hidden at first", (await display()) === "none", await display());
      await page.select(".wipe select", "residuals");
      expect("and shown when asked for", (await display()) === "block", await display());
      await picture(page, "residuals");
      await page.select(".wipe select", "both");
    }
    const names = await page.$$eval("input, select, canvas, svg[role]", (elements) =>
      elements.filter((e) => !e.getAttribute("aria-label") && !e.closest("label")).length);
    expect("every control has a name", names === 0, names);
  }
  if ((await page.evaluate(() => document.documentElement.dataset.model)) === "1") {
    const where = () => page.$eval("#model", (canvas) => canvas.dataset.camera);
    const canvas = await page.$("#model");
    await canvas.scrollIntoView();
    const box = await canvas.boundingBox();
    const first = await where();
    await page.mouse.move(box.x + 300, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 420, box.y + 230, { steps: 4 });
    await page.mouse.up();
    await page.waitForFunction((old) => document.getElementById("model").dataset.camera !== old,
      { timeout: 30000 }, first);
    const second = await where();
    expect("the model turns by the mouse", first !== second, second);
    await canvas.focus();
    await page.keyboard.press("ArrowLeft");
    await page.waitForFunction((old) => document.getElementById("model").dataset.camera !== old,
      { timeout: 30000 }, second);
    expect("and by the keyboard", true, await where());
    await picture(page, "model");
    for (const mode of (await page.$("#model_mode")) ? ["which", "seen", "photographed"] : []) {
      const before = await canvas.screenshot();
      await page.select("#model_mode", mode);
      await page.waitForFunction((wanted) =>
        document.getElementById("model").dataset.mode === wanted, { timeout: 60000 }, mode);
      await new Promise((done) => setTimeout(done, 1500));
      const after = await canvas.screenshot();
      const legend = await page.$eval("#model_legend", (element) => element.children.length);
      expect("the model coloured by " + mode, !before.equals(after), legend + " in the legend");
      await picture(page, "model_" + mode);
    }
  }
  await page.close();
}

// A telephone in the dark.
{
  const { page, seen } = await open(
    { width: 390, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2 }, "dark");
  expect("no errors on a telephone", seen.errors.length === 0, seen.errors.join(" | "));
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  expect("as wide as a telephone", width <= 390, width);
  const paper = await page.$eval("body", (body) => getComputedStyle(body).backgroundColor);
  expect("dark", paper === "rgb(28, 27, 25)", paper);
  await picture(page, "telephone");
  const wipe = await page.$(".frame input");
  if (wipe) {
    // What comes into view is laid out only then, and moves what is below.
    for (let i = 0; i < 3; ++i) {
      await wipe.scrollIntoView();
      await new Promise((done) => setTimeout(done, 300));
    }
    const box = await wipe.boundingBox();
    await page.touchscreen.touchStart(box.x + box.width / 2, box.y + 60);
    await page.touchscreen.touchMove(box.x + box.width * 0.8, box.y + 60);
    await page.touchscreen.touchEnd();
    const at = await page.$eval(".wipe", (element) => element.style.getPropertyValue("--at"));
    expect("a wipe follows a finger", parseFloat(at) > 65, at);
    await picture(page, "telephone_wipe");
  }
  if ((await page.evaluate(() => document.documentElement.dataset.model)) === "1") {
    const canvas = await page.$("#model");
    await canvas.scrollIntoView();
    await new Promise((done) => setTimeout(done, 300));
    const box = await canvas.boundingBox();
    const where = () => page.$eval("#model", (element) => element.dataset.camera);
    const distance = () => page.$eval("#model", (element) => Number(element.dataset.distance));
    const moved = async (old) => {
      await page.waitForFunction((was) => document.getElementById("model").dataset.camera !== was,
        { timeout: 30000 }, old);
      return where();
    };
    const x = box.x + box.width / 2;
    const y = box.y + box.height / 2;
    const first = await where();
    await page.touchscreen.touchStart(x, y);
    for (let i = 1; i <= 4; ++i) await page.touchscreen.touchMove(x + 20 * i, y);
    await page.touchscreen.touchEnd();
    const second = await moved(first);
    expect("the model turns by a finger", first !== second, second);
    const far = await distance();
    const client = await page.createCDPSession();
    const fingers = (type, apart) => client.send("Input.dispatchTouchEvent", { type,
      touchPoints: apart === 0 ? [] : [{ x: x - apart, y, id: 1 }, { x: x + apart, y, id: 2 }] });
    await fingers("touchStart", 40);
    for (let i = 1; i <= 5; ++i) await fingers("touchMove", 40 + 14 * i);
    await fingers("touchEnd", 0);
    await moved(second);
    expect("two fingers bring it nearer", (await distance()) < 0.8 * far,
      far + " to " + (await distance()));
    await picture(page, "telephone_model");
  }
  await page.close();
}
await browser.close();
process.exit(faults > 0 ? 1 : 0);
