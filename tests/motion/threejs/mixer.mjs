// What three.js makes of glTF animations: reads [{file, times: [[seconds, ...] per animation]}] on stdin and
// prints for each file its poses: world matrices of all nodes, depth first, and world positions of all vertices.

import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

globalThis.self = globalThis;
globalThis.ProgressEvent ??= class extends Event {};

const { AnimationMixer, Vector3 } = await import('three');
const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;

// The document with its buffers inside and without pictures, which need a browser.
function documentOf(file) {
  const bytes = readFileSync(file);
  let document, own;
  if (bytes.length > 12 && bytes.readUInt32LE(0) === MAGIC) {
    for (let at = 12; at < bytes.length; at += 8 + bytes.readUInt32LE(at)) {
      const chunk = bytes.subarray(at + 8, at + 8 + bytes.readUInt32LE(at));
      if (bytes.readUInt32LE(at + 4) === JSON_CHUNK) document = JSON.parse(chunk.toString());
      else own = chunk;
    }
  } else document = JSON.parse(bytes.toString());
  for (const buffer of document.buffers ?? []) {
    if (buffer.uri?.startsWith('data:')) continue;
    const content = buffer.uri ? readFileSync(join(dirname(file), decodeURIComponent(buffer.uri))) : own;
    buffer.uri = 'data:application/octet-stream;base64,' + content.toString('base64');
  }
  for (const name of ['images', 'textures', 'samplers', 'materials']) delete document[name];
  for (const mesh of document.meshes ?? []) for (const primitive of mesh.primitives) delete primitive.material;
  return document;
}

// Where every node and every vertex is now; a node without a mesh has no vertices.
function poseOf(gltf, document, order) {
  gltf.scene.updateMatrixWorld(true);
  const objects = new Map();
  const meshes = new Map();
  gltf.scene.traverse((object) => {
    const { nodes, primitives } = gltf.parser.associations.get(object) ?? {};
    if (nodes !== undefined) objects.set(nodes, object);
    if (object.isMesh) {
      const node = nodes ?? gltf.parser.associations.get(object.parent).nodes;
      if (!meshes.has(node)) meshes.set(node, []);
      meshes.get(node)[primitives ?? 0] = object;
    }
  });
  const point = new Vector3();
  const pointsOf = (mesh) => {
    const points = [];
    for (let i = 0; i < mesh.geometry.attributes.position.count; i++) {
      mesh.getVertexPosition(i, point).applyMatrix4(mesh.matrixWorld);
      points.push(point.x, point.y, point.z);
    }
    return points;
  };
  return {
    world: order.map((node) => [...objects.get(node).matrixWorld.elements]),
    points: order.map((node) => (meshes.get(node) ?? []).flatMap(pointsOf)),
  };
}

// glTF asks for rotations of length one and three.js takes them for granted; some files round theirs to three
// digits, which would make three.js scale what they turn.
function makeTurnsUnit(animation) {
  for (const { ValueTypeName, values, times } of animation.tracks) {
    if (ValueTypeName !== 'quaternion' || values.length !== 4 * times.length) continue;
    for (let i = 0; i < values.length; i += 4) {
      const length = Math.hypot(...values.subarray(i, i + 4));
      for (let k = 0; k < 4; k++) values[i + k] /= length;
    }
  }
}

function depthFirst(document) {
  const walk = (node) => [node, ...(document.nodes[node].children ?? []).flatMap(walk)];
  return document.scenes[document.scene ?? 0].nodes.flatMap(walk);
}

async function posesOf({ file, times }) {
  const document = documentOf(file);
  const gltf = await new GLTFLoader().parseAsync(JSON.stringify(document), '');
  const order = depthFirst(document);
  const rest = poseOf(gltf, document, order);
  const clips = gltf.animations.map((animation, index) => {
    makeTurnsUnit(animation);
    const mixer = new AnimationMixer(gltf.scene);
    const action = mixer.clipAction(animation).play();
    const poses = times[index].map((time) => {
      action.time = time;
      mixer.update(0);
      return poseOf(gltf, document, order);
    });
    mixer.stopAllAction();
    return poses;
  });
  return { rest, clips };
}

const answers = [];
for (const request of JSON.parse(readFileSync(0, 'utf8'))) answers.push(await posesOf(request));
process.stdout.write(JSON.stringify(answers));
