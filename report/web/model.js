// The model to turn in the report's page. SPDX-License-Identifier: Apache-2.0
import { Box3, Color, DataTexture, MeshBasicMaterial, NearestFilter, PerspectiveCamera, Scene, Spherical,
  SRGBColorSpace, Vector3, WebGLRenderer } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const canvas = document.getElementById("model");
const status = document.getElementById("model_status");

function bytesOf(element) {
  const text = atob(element.textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

// What the model can be coloured by besides its photographs: which photograph a place is from, or
// whether any shows it. 0 is none, 65535 what was filled in from beside.
const kNone = [58, 54, 50];
const kFilled = [190, 190, 190];
const kSeen = [72, 140, 108];

// Steps of the golden ratio on the circle of hues.
function colourOfNumber(number) {
  const hue = 6 * ((number * 0.61803398875 + 0.1) % 1);
  return [4, 2, 0].map((shift) => {
    const wave = Math.abs(((hue + shift) % 6) - 3) - 1;
    return Math.round(90 + 140 * Math.min(1, Math.max(0, wave)));
  });
}

const colours = {
  which: (n) => (n === 0 ? kNone : n === 65535 ? kFilled : colourOfNumber(n)),
  seen: (n) => (n === 0 ? kNone : n === 65535 ? kFilled : kSeen),
};

async function numbersOf(base64) {
  const image = new Image();
  image.src = "data:image/png;base64," + base64;
  await image.decode();
  const flat = document.createElement("canvas");
  flat.width = image.width;
  flat.height = image.height;
  const context = flat.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, image.width, image.height);
}

function textureOf(numbers, colourOf) {
  const data = new Uint8Array(numbers.data.length);
  for (let i = 0; i < data.length; i += 4) {
    data.set(colourOf(numbers.data[i] + 256 * numbers.data[i + 1]), i);
    data[i + 3] = 255;
  }
  const texture = new DataTexture(data, numbers.width, numbers.height);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

function legendOf(mode, numbers, names) {
  const entries = [];
  const present = new Set();
  for (const page of numbers) {
    for (let i = 0; i < page.data.length; i += 4) present.add(page.data[i] + 256 * page.data[i + 1]);
  }
  if (mode === "which") {
    names.forEach((name, i) => { if (present.has(i + 1)) entries.push([name, colourOfNumber(i + 1)]); });
  } else {
    entries.push(["in a photograph", kSeen]);
  }
  if (present.has(65535)) entries.push(["filled in from beside", kFilled]);
  entries.push(["in none", kNone]);
  return entries.map(([text, colour]) => {
    const entry = document.createElement("span");
    const swatch = document.createElement("i");
    swatch.style.background = `rgb(${colour})`;
    entry.append(swatch, text);
    return entry;
  });
}

// Lets the person choose; `request` draws.
function offerModes(model, request) {
  const held = document.getElementById("model_modes");
  const choice = document.getElementById("model_mode");
  if (!held || !choice) return;
  const { names, pages } = JSON.parse(held.textContent);
  const legend = document.getElementById("model_legend");
  const materials = new Map();
  model.traverse((part) => {
    if (!part.material || materials.has(part.material)) return;
    materials.set(part.material, { map: part.material.map, color: part.material.color.clone() });
  });
  let numbers = null;
  const textures = {};
  choice.addEventListener("change", async () => {
    const mode = choice.value;
    numbers ??= await Promise.all(pages.map(numbersOf));
    if (colours[mode]) textures[mode] ??= numbers.map((page) => textureOf(page, colours[mode]));
    for (const [material, own] of materials) {
      const page = /^page_(\d+)/.exec(material.name);
      const other = colours[mode] && page ? textures[mode][Number(page[1])] : null;
      material.map = other ?? own.map;
      material.color.copy(own.color);
      if (colours[mode] && !page) material.color.copy(new Color(`rgb(${kNone})`));
      material.needsUpdate = true;
    }
    legend.replaceChildren(...(colours[mode] ? legendOf(mode, numbers, names) : []));
    request();
    canvas.dataset.mode = mode;
  });
}

// There are no lights: a material that waits for them would be black.
function unlight(model) {
  model.traverse((part) => {
    const lit = part.material;
    if (!lit || lit.isMeshBasicMaterial) return;
    part.material = new MeshBasicMaterial({ color: lit.color, map: lit.map, side: lit.side });
    part.material.name = lit.name;
  });
}

function show(gltf) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
  const scene = new Scene();
  unlight(gltf.scene);
  scene.add(gltf.scene);
  const box = new Box3().setFromObject(gltf.scene);
  const middle = box.getCenter(new Vector3());
  const size = box.getSize(new Vector3()).length();
  const camera = new PerspectiveCamera(40, 1, size / 1000, size * 20);
  const controls = new OrbitControls(camera, canvas);
  controls.target.copy(middle);
  const home = new Spherical(size * 1.15, 1.25, 0.6);

  let waits = false;
  const draw = () => {
    waits = false;
    renderer.render(scene, camera);
    canvas.dataset.distance = camera.position.distanceTo(controls.target).toFixed(3);
    canvas.dataset.camera = camera.position.toArray().map((v) => v.toFixed(3)).join(" ");
  };
  // On change only.
  const request = () => {
    if (waits) return;
    waits = true;
    requestAnimationFrame(draw);
  };
  const place = (spherical) => {
    camera.position.setFromSpherical(spherical).add(middle);
    controls.update();
    request();
  };
  const fit = () => {
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    request();
  };
  controls.addEventListener("change", request);
  new ResizeObserver(fit).observe(canvas);

  const steps = {
    ArrowLeft: [-0.15, 0, 1], ArrowRight: [0.15, 0, 1], ArrowUp: [0, -0.12, 1],
    ArrowDown: [0, 0.12, 1], "+": [0, 0, 0.85], "=": [0, 0, 0.85], "-": [0, 0, 1.18],
  };
  canvas.addEventListener("keydown", (event) => {
    const now = new Spherical().setFromVector3(camera.position.clone().sub(middle));
    const step = steps[event.key];
    if (event.key === "Home") {
      place(home);
    } else if (step) {
      now.theta += step[0];
      now.phi = Math.min(Math.PI - 0.05, Math.max(0.05, now.phi + step[1]));
      now.radius *= step[2];
      place(now);
    } else {
      return;
    }
    event.preventDefault();
  });
  offerModes(gltf.scene, request);
  fit();
  place(home);
  draw();
  status.textContent = "";
  document.documentElement.dataset.model = "1";
}

function start() {
  try {
    const loader = new GLTFLoader();
    loader.parse(bytesOf(document.getElementById("model_glb")), "", show, (error) => {
      status.textContent = "The model cannot be shown: " + error.message;
    });
  } catch (error) {
    status.textContent = "The model cannot be shown: this browser has no WebGL.";
    document.documentElement.dataset.model = "0";
  }
}
if (canvas) start();
