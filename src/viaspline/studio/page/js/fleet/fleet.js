/** A fleet on the page: its newest plan, the robot that is chosen, and the panels that only fleets have. */

import { addRobot, fleetOf, isFleet, missionFile, removeRobot, robotName } from "../core/fleet.js";
import { FleetPlan } from "../core/fleet_plan.js";
import { bodyOf } from "../core/mission.js";
import { FleetProof } from "./fleet_proof.js";
import { RobotFields } from "./robot_fields.js";
import { RobotList } from "./robot_list.js";

export class Fleet {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.plan = new FleetPlan(); // all that this page has ever been told: the server sends what is new
    this.list = new RobotList(app);
    this.proof = new FleetProof(app);
    this.fields = new RobotFields(app);
    const { store } = app;
    store.on("robot", () => this.chosen());
    store.on("document file", () => this.dress());
    store.on("elsewhere", () => this.sayElsewhere());
    document.querySelector("#make-fleet")?.addEventListener("click", () => this.make());
  }

  /** Say that a mission is only shown here, and where it is edited. */
  sayElsewhere() {
    const { store, toast } = this.app;
    const { mission } = store.file.fleet[store.robot];
    toast(`The mission of ${robotName(store.file, store.robot)} stands in ${mission}: here it is only shown.`, "", { label: `Open ${mission}`, act: () => this.openMission(mission) });
  }

  /** Open the file of a robot's mission instead of the fleet's. @param {string} mission as the fleet names it */
  openMission(mission) {
    const { files, store } = this.app;
    files.leaving(() => files.load(missionFile(store.name, mission)));
  }

  /** What only a fleet has is shown only then. */
  dress() {
    const is = isFleet(this.app.store.file);
    document.body.classList.toggle("is-fleet", is);
    for (const id of ["#fleet-list-section", "#fleet-section", "#robot-section"]) /** @type {HTMLElement} */ (document.querySelector(id)).hidden = !is;
    /** @type {HTMLElement} */ (document.querySelector("#make-fleet")).hidden = is;
  }

  /** Take up what the server says of a fleet. @param {any} answer */
  take(answer) {
    const { store } = this.app;
    this.plan.take(answer);
    if (store.robot === null) return; // said of a file that was left meanwhile
    const missions = answer.missions ?? {};
    if (JSON.stringify(missions) !== JSON.stringify(store.missions)) {
      store.missions = missions;
      store.take();
    }
    store.fleetPlan = this.plan;
    this.show();
  }

  /** The plan of the robot that is chosen becomes the one that is shown. */
  show() {
    const { store } = this.app;
    if (store.robot === null || !store.fleetPlan?.answer) return;
    store.plan = store.fleetPlan.planOf(store.file, store.robot);
    store.goodPlan = store.fleetPlan.goodPlanOf(store.file, store.robot);
    store.curve = store.fleetPlan.byName.get(robotName(store.file, store.robot))?.curve ?? null;
  }

  /** Another robot is edited from now on. */
  chosen() {
    const { store, say } = this.app;
    this.show();
    store.lookAt(null);
    store.tell("document");
    store.tell("plan");
    if (store.robot !== null) say(`${robotName(store.file, store.robot)} is chosen`);
  }

  /** Choose the robot that something in the document belongs to. @param {number|null|undefined} robot */
  choose(robot) {
    if (robot !== null && robot !== undefined) this.app.store.choose(robot);
  }

  add() {
    const { store } = this.app;
    const { radius } = bodyOf(store.doc);
    const aside = 2 * radius + Number(store.file.separation_m ?? 0.5) + 1;
    const [file, robot] = addRobot(store.file, store.robot, store.doc, aside);
    store.editFile(file, { select: null, robot });
  }

  remove() {
    const { store, toast } = this.app;
    const file = removeRobot(store.file, store.robot);
    if (file === store.file) toast("A fleet has one robot at least.");
    else store.editFile(file, { select: null, robot: Math.max(0, store.robot - 1) });
  }

  /** Make a fleet of the mission. */
  make() {
    const { store } = this.app;
    if (store.robot === null) store.editFile(fleetOf(store.file), { robot: 0 });
  }
}

