// The model to turn in the report's page. SPDX-License-Identifier: Apache-2.0
import { Box3, PerspectiveCamera, Scene, Spherical, Vector3, WebGLRenderer } from "three";
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

function show(gltf) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
  const scene = new Scene();
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
