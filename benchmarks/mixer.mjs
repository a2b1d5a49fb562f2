// The peer of skinning.py: a tree of joints and its tracks in three.js's mixer. The first line on stdin describes
// them; every further line asks for all world matrices at all times once more. Answers with a line for each.

import { createInterface } from 'node:readline';
import { AnimationClip, AnimationMixer, Bone, QuaternionKeyframeTrack, VectorKeyframeTrack } from 'three';

const NAMES = { translation: 'position', rotation: 'quaternion', scale: 'scale' };

function build({ parents, times, tracks }) {
  const bones = parents.map((_, index) => Object.assign(new Bone(), { name: `joint${index}` }));
  const root = new Bone();
  parents.forEach((parent, index) => (parent < 0 ? root : bones[parent]).add(bones[index]));
  const mixer = new AnimationMixer(root);
  const clip = new AnimationClip('dance', -1, tracks.map(({ node, property, times, values }) => {
    const Track = property === 'rotation' ? QuaternionKeyframeTrack : VectorKeyframeTrack;
    return new Track(`joint${node}.${NAMES[property]}`, times, values);
  }));
  const action = mixer.clipAction(clip).play();
  return () => {
    for (const time of times) {
      action.time = time;
      mixer.update(0);
      root.updateMatrixWorld();
    }
  };
}

let run;
for await (const line of createInterface({ input: process.stdin })) {
  if (run) run();
  else run = build(JSON.parse(line));
  console.log('done');
}
