// Opens pages in headless Chromium and holds what they show against pictures. Used by tests/exports/browser.
import { execFileSync, spawn } from "node:child_process";
import { createReadStream, existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";

/// A browser that is spoken to by its debugging protocol, on two pipes: messages end with a zero byte.
export class Browser {
  constructor(width, height) {
    this.process = spawn("chromium", ["--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--no-first-run",
      "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
      "about:blank"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    [this.width, this.height] = [width, height];
    this.waiting = new Map();
    this.events = [];
    this.count = 0;
    let text = "";
    this.process.stdio[4].setEncoding("utf8").on("data", (piece) => {
      text += piece;
      const messages = text.split("\0");
      text = messages.pop();
      messages.forEach((message) => this.receive(JSON.parse(message)));
    });
  }

  receive(message) {
    if (message.method === "Runtime.exceptionThrown") {
      this.events.push(message.params.exceptionDetails.exception?.description ?? message.params.exceptionDetails.text);
    }
    if (!this.waiting.has(message.id)) return;
    const [resolve, reject] = this.waiting.get(message.id);
    message.error ? reject(new Error(message.error.message)) : resolve(message.result);
  }

  send(method, params = {}) {
    const id = ++this.count;
    const message = { id, method, params, sessionId: this.session };
    return new Promise((resolve, reject) => {
      this.waiting.set(id, [resolve, reject]);
      this.process.stdio[3].write(JSON.stringify(message) + "\0");
    });
  }

  async open(address) {
    this.session = undefined;
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    this.session = (await this.send("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    await this.send("Runtime.enable");
    await this.send("Page.enable");
    await this.send("Emulation.setDeviceMetricsOverride",
      { width: this.width, height: this.height, deviceScaleFactor: 1, mobile: false });
    await this.send("Page.navigate", { url: address });
  }

  async value(expression) {
    const answer = await this.send("Runtime.evaluate", { expression, returnByValue: true, awaitPromise: true });
    if (answer.exceptionDetails) throw new Error(answer.exceptionDetails.exception?.description ?? expression);
    return answer.result.value;
  }

  async until(expression) {
    for (let look = 0; look < 600; ++look) {
      if (await this.value(expression).catch(() => false)) return;
      if (this.events.length > 0) throw new Error(this.events.join("\n"));
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    throw new Error(`the page never came to: ${expression}`);
  }

  async picture() {
    const { data } = await this.send("Page.captureScreenshot", { format: "png" });
    return Buffer.from(data, "base64");
  }

  close() { this.process.kill(); }
}

/// Files of a folder on a port of this machine; modules are not read from files.
export async function serve(folder) {
  const kinds = { ".html": "text/html", ".js": "text/javascript", ".glb": "model/gltf-binary" };
  const server = createServer((request, response) => {
    const file = join(folder, new URL(request.url, "http://127.0.0.1").pathname);
    if (!existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": kinds[extname(file)] ?? "application/octet-stream" });
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return server;
}

/// Red, green, blue, opacity of every pixel.
export function pixels(png) {
  return execFileSync("ffmpeg", ["-v", "error", "-i", "-", "-f", "rawvideo", "-pix_fmt", "rgba", "-"],
    { input: png, maxBuffer: 1 << 28 });
}

/// Where something is: not the background of the page, or opaque in a picture without one.
export function silhouette(rgba, background) {
  return Uint8Array.from({ length: rgba.length / 4 }, (_, i) => {
    if (!background) return rgba[4 * i + 3] > 127;
    return Math.max(...background.map((level, k) => Math.abs(rgba[4 * i + k] - level))) > 6;
  });
}

export const silhouette_of_file = (file) => silhouette(pixels(readFileSync(file)));

/// Pixels in one and not in the other, as a share of those in the first.
export function difference(a, b, size) {
  let [differ, inside] = [0, 0];
  for (let i = 0; i < size; ++i) {
    inside += a[i];
    differ += a[i] !== b[i];
  }
  return differ / inside;
}
