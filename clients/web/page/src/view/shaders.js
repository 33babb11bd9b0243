// GLSL of the body. `value` is the number that a particle is coloured by; `scale` brings it to 0..1 of the map.

const COLOUR = /* glsl */ `
  uniform sampler2D map;
  uniform vec2 scale;   // factor, offset
  uniform vec3 plain;
  uniform float mapped; // 0: plain
  vec3 colour_of(float value) {
    vec3 colour = texture2D(map, vec2(clamp(value * scale.x + scale.y, 0.002, 0.998), 0.5)).rgb;
    return mix(plain, colour, mapped);
  }
`;

// A key light from above the shoulder, sky and ground light, a soft highlight and a rim, by the side one sees.
const LIGHT = /* glsl */ `
  vec3 lit(vec3 colour, vec3 n, vec3 eye) {
    vec3 key = normalize(vec3(0.45, 0.75, 0.62));
    vec3 up = normalize((viewMatrix * vec4(0.0, 0.0, 1.0, 0.0)).xyz);
    float sky = 0.5 + 0.5 * dot(n, up);
    float diffuse = max(dot(n, key), 0.0);
    float rim = pow(1.0 - max(dot(n, eye), 0.0), 4.0);
    float shine = pow(max(dot(n, normalize(key + eye)), 0.0), 40.0);
    vec3 light = mix(vec3(0.52, 0.51, 0.54), vec3(0.86, 0.88, 0.92), sky) + diffuse * vec3(0.34, 0.33, 0.3);
    return colour * light + shine * 0.16 + rim * 0.10 * sky;
  }
`;

export const SURFACE = {
  vertexShader: /* glsl */ `
    attribute float value;
    varying vec3 seen_normal;
    varying vec3 seen_position;
    varying float seen_value;
    void main() {
      vec4 at = modelViewMatrix * vec4(position, 1.0);
      seen_normal = normalMatrix * normal;
      seen_position = at.xyz;
      seen_value = value;
      gl_Position = projectionMatrix * at;
    }`,
  fragmentShader: /* glsl */ `
    varying vec3 seen_normal;
    varying vec3 seen_position;
    varying float seen_value;
    ${COLOUR}
    ${LIGHT}
    void main() {
      vec3 eye = normalize(-seen_position);
      vec3 n = normalize(seen_normal);
      if (dot(n, eye) < 0.0) n = -n;
      gl_FragColor = vec4(lit(colour_of(seen_value), n, eye), 1.0);
    }`,
};

// Balls: squares that face the eye, of a radius in metres but never smaller than a pixel or two.
export const BALLS = {
  vertexShader: /* glsl */ `
    attribute float value;
    uniform float radius;
    uniform float pixels; // height of the picture
    uniform float ratio;  // device pixels per pixel
    varying float seen_value;
    void main() {
      vec4 at = modelViewMatrix * vec4(position, 1.0);
      seen_value = value;
      gl_Position = projectionMatrix * at;
      gl_PointSize = clamp(radius * projectionMatrix[1][1] * pixels / gl_Position.w, 2.5 * ratio, 64.0);
    }`,
  fragmentShader: /* glsl */ `
    varying float seen_value;
    ${COLOUR}
    ${LIGHT}
    void main() {
      vec2 at = 2.0 * gl_PointCoord - 1.0;
      float square = dot(at, at);
      if (square > 1.0) discard;
      vec3 n = vec3(at.x, -at.y, sqrt(1.0 - square));
      gl_FragColor = vec4(lit(colour_of(seen_value), n, vec3(0.0, 0.0, 1.0)), 1.0);
    }`,
};

// Springs: a ribbon of some pixels' width per instance, `corner` = (end, side).
export const RIBBONS = {
  vertexShader: /* glsl */ `
    attribute vec2 corner;
    attribute vec3 start;
    attribute vec3 end;
    attribute vec2 values;
    uniform vec2 resolution;
    uniform float width;
    varying float seen_value;
    void main() {
      vec4 a = projectionMatrix * modelViewMatrix * vec4(start, 1.0);
      vec4 b = projectionMatrix * modelViewMatrix * vec4(end, 1.0);
      vec2 along = (b.xy / b.w - a.xy / a.w) * resolution;
      float size = length(along);
      vec2 side = size > 0.0 ? vec2(-along.y, along.x) / size : vec2(0.0);
      vec4 at = mix(a, b, corner.x);
      at.xy += side * corner.y * width / resolution * at.w;
      seen_value = mix(values.x, values.y, corner.x);
      gl_Position = at;
    }`,
  fragmentShader: /* glsl */ `
    varying float seen_value;
    uniform float opacity;
    ${COLOUR}
    void main() {
      gl_FragColor = vec4(colour_of(seen_value) * 0.92, opacity);
    }`,
};

// The shadow on the ground, of a sun that stands high.
export const SHADOW = {
  vertexShader: /* glsl */ `
    uniform float ground;
    uniform float lift;
    varying float height;
    void main() {
      height = position.z - ground;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position.xy + 0.12 * height, ground + lift, 1.0);
    }`,
  fragmentShader: /* glsl */ `
    uniform float strength;
    varying float height;
    void main() {
      if (height < 0.0) discard;
      gl_FragColor = vec4(0.03, 0.04, 0.08, strength);
    }`,
};

// The ground: lines every `spacing` and every five of them, fading out towards the horizon.
export const GRID = {
  vertexShader: /* glsl */ `
    varying vec2 place;
    void main() {
      vec4 at = modelMatrix * vec4(position, 1.0);
      place = at.xy;
      gl_Position = projectionMatrix * viewMatrix * at;
    }`,
  fragmentShader: /* glsl */ `
    uniform float spacing;
    uniform float reach;
    uniform vec2 centre;
    uniform vec3 line;
    uniform float strength;
    varying vec2 place;
    float lines(float step, float width) {
      vec2 at = place / step;
      vec2 thin = fwidth(at);
      vec2 near = abs(fract(at - 0.5) - 0.5) / max(thin, 1e-6);
      vec2 seen = (1.0 - smoothstep(vec2(width - 0.5), vec2(width + 0.5), near)) * (1.0 - smoothstep(0.25, 0.6, thin));
      return max(seen.x, seen.y);
    }
    void main() {
      float fade = 1.0 - smoothstep(0.35, 1.0, distance(place, centre) / reach);
      float seen = max(0.3 * lines(spacing / 5.0, 0.5), lines(spacing, 0.75));
      gl_FragColor = vec4(line, strength * seen * fade);
    }`,
};
