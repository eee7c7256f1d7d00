// A thing in the photo, in the photo's light, fast enough to be dragged: a preview of what the path tracer draws.
//
//   const stage = new Stage(canvas, { camera, up, photo }, (lost) => { ... });
//   stage.setLight({ rest, lamp });
//   stage.setModel(pot, null);
//   stage.place(placement);
//
// Draws when something has changed, not all the time. Radiance 1 is the photo's white, so no tone mapping.
// A browser may take the graphics away and give them back; the stage says so, keeps what it is told meanwhile, and goes on.

import {
  type DirectionalLight,
  Matrix4,
  PerspectiveCamera,
  Quaternion,
  Raycaster,
  Scene,
  Sphere,
  SRGBColorSpace,
  Texture,
  Vector2,
  Vector3,
  VSMShadowMap,
  WebGLRenderer,
} from 'three';

import type { MainLight, Material, ObjectModel } from '../api/types.ts';
import { fieldOfViewDeg, pointAt, type PhotoCamera } from '../light/camera.ts';
import { alphaOfDisc } from '../light/lamp.ts';
import type { Placement } from '../light/placement.ts';
import type { RadianceMap } from '../light/radiance_map.ts';
import { lampShare } from '../light/shadow.ts';
import type { Vec3 } from '../light/vector.ts';
import { surroundings } from './environment.ts';
import { Ground } from './ground.ts';
import { aim, lampOf } from './lamp.ts';
import { standing, type StandingModel } from './model.ts';

interface StageLight {
  rest: RadianceMap; // the map without its main lamp
  lamp: MainLight | null;
}

interface StagePhoto {
  camera: PhotoCamera;
  up: Vec3;
  photo: HTMLImageElement; // loaded
}

const glassLetsPass = 0.7;
const mostPixelRatio = 2;

export class Stage {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly view: PerspectiveCamera;
  private readonly up: Vector3;
  private readonly backdrop: Texture;
  private readonly ground = new Ground();
  private readonly lampWidth = { value: 0 };
  private model: StandingModel | null = null;
  private light: StageLight | null = null;
  private lamp: DirectionalLight | null = null;
  private environment: { dispose(): void } | null = null;
  private placement: Placement | null = null;
  private share = 0; // of the ground's light, the lamp's
  private frame = 0;
  private lost = false;

  // Throws when the browser has no WebGL.
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly picture: StagePhoto,
    private readonly onLost: (lost: boolean) => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    canvas.addEventListener('webglcontextlost', this.lose);
    canvas.addEventListener('webglcontextrestored', this.regain); // after the renderer's own, which makes its state anew
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = VSMShadowMap;
    const { camera } = picture;
    this.view = new PerspectiveCamera(fieldOfViewDeg(camera), camera.widthPx / camera.heightPx, 0.01, 1000);
    this.up = new Vector3(...picture.up).normalize();
    this.backdrop = new Texture(picture.photo);
    this.backdrop.colorSpace = SRGBColorSpace;
    this.backdrop.needsUpdate = true;
    this.scene.background = this.backdrop;
    this.scene.add(this.ground.group);
  }

  setLight(light: StageLight): void {
    this.light = light;
    if (this.lost) return; // nothing can be drawn, so nothing be blurred
    this.environment?.dispose();
    const around = surroundings(this.renderer, light.rest);
    this.environment = around;
    this.scene.environment = around.texture;
    if (this.lamp) {
      this.scene.remove(this.lamp, this.lamp.target);
      this.lamp.dispose();
    }
    this.lamp = light.lamp && lampOf(light.lamp);
    if (this.lamp) this.scene.add(this.lamp, this.lamp.target);
    this.lampWidth.value = light.lamp ? alphaOfDisc(light.lamp.solid_angle_sr) : 0;
    this.share = light.lamp ? lampShare(light.lamp, light.rest, this.picture.up) : 0;
    this.shade();
    this.arrange();
  }

  // What the server calls a model with, or without (null), another material in place of its own.
  setModel(model: ObjectModel, material: Material | null): void {
    if (this.model) {
      this.scene.remove(this.model.group);
      this.model.dispose();
    }
    this.model = standing(model, material, this.lampWidth);
    this.scene.add(this.model.group);
    this.shade();
    this.arrange();
  }

  place(placement: Placement): void {
    this.placement = placement;
    this.arrange();
  }

  resize(width: number, height: number): void {
    this.renderer.setPixelRatio(Math.min(mostPixelRatio, devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.draw();
  }

  // Whether the object's box is at that point of the canvas; shares of its width and height, from the top left.
  hits(x: number, y: number): boolean {
    if (!this.model) return false;
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(2 * x - 1, 1 - 2 * y), this.view);
    const { group, box } = this.model;
    return caster.ray.applyMatrix4(new Matrix4().copy(group.matrixWorld).invert()).intersectsBox(box);
  }

  dispose(): void {
    this.canvas.removeEventListener('webglcontextlost', this.lose);
    this.canvas.removeEventListener('webglcontextrestored', this.regain);
    cancelAnimationFrame(this.frame);
    this.model?.dispose();
    this.lamp?.dispose();
    this.environment?.dispose();
    this.ground.dispose();
    this.backdrop.dispose();
    this.renderer.dispose();
    // Browsers allow few contexts at a time.
    this.renderer.forceContextLoss();
  }

  private readonly lose = (event: Event) => {
    event.preventDefault(); // else it never comes back
    this.lost = true;
    this.onLost(true);
  };

  // three.js sends meshes and pictures again by itself, but the blurred surroundings were drawn, and went with the context.
  private readonly regain = () => {
    this.lost = false;
    if (this.light) this.setLight(this.light);
    this.draw();
    this.onLost(false);
  };

  private shade(): void {
    this.ground.setLight(this.share, this.model?.glass ? glassLetsPass : 0);
  }

  private arrange(): void {
    const { model, placement, light } = this;
    if (!model || !placement || !light) return;
    const foot = new Vector3(...pointAt(this.picture.camera, placement.atPx, placement.distanceM));
    const upright = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), this.up);
    const turn = new Quaternion().setFromAxisAngle(this.up, (placement.turnDeg * Math.PI) / 180);
    const scale = placement.heightM / model.size.height;
    for (const group of [model.group, this.ground.group]) {
      group.position.copy(foot);
      group.quaternion.copy(turn).multiply(upright);
    }
    model.group.scale.setScalar(scale);
    model.group.updateMatrixWorld();
    const { width, height, depth } = model.size;
    this.ground.setSize({ width: scale * width, height: scale * height, depth: scale * depth });

    if (light.lamp && this.lamp) {
      aim(this.lamp, light.lamp, model.box.getBoundingSphere(new Sphere()).applyMatrix4(model.group.matrixWorld));
    }
    this.draw();
  }

  private draw(): void {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.renderer.render(this.scene, this.view);
    });
  }
}
