"""The report's reflection as a BSDF of Mitsuba 3: f = kd/pi + ks (n+1)/(2 pi) cos^n alpha on both sides of a surface, alpha being
the angle to the mirror direction (eq. (3)), sampled by the report's p6: the lobe or the cosine with the odds of ks : kd."""

import drjit as dr
import mitsuba as mi


class Phong(mi.BSDF):
    """Properties: kd and ks (RGB), exponent. wi is towards the camera and wo towards the light, as Mitsuba has it."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.kd, self.ks = (mi.Color3f(props[name]) for name in ("kd", "ks"))
        self.n = mi.Float(props["exponent"])
        diffuse, specular = dr.sum(self.kd), dr.sum(self.ks)
        self.diffuse_odds = diffuse / (diffuse + specular)
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [mi.BSDFFlags.GlossyReflection | sides, mi.BSDFFlags.DiffuseReflection | sides]
        self.m_flags = self.m_components[0] | self.m_components[1]

    def traverse(self, callback):
        """Makes the numbers data of one shared kernel instead of constants of one kernel for each material."""
        for name in ("kd", "ks", "n", "diffuse_odds"):
            callback.put(name, getattr(self, name), mi.ParamFlags.NonDifferentiable)

    def _to_front(self, wi, *directions):
        """All of them mirrored to the side of z > 0 where wi lies below."""
        return [mi.Vector3f(w.x, w.y, dr.mulsign(w.z, wi.z)) for w in (wi, *directions)]

    def _mirror(self, wi):
        return mi.Vector3f(-wi.x, -wi.y, wi.z)

    def _value_and_pdf(self, wi, wo):
        """f cos and density of directions above the surface; 0 below."""
        above = (wi.z > 0) & (wo.z > 0)
        power = dr.power(dr.maximum(dr.dot(wo, self._mirror(wi)), 0), self.n)
        lobe = (self.n + 1) * dr.inv_two_pi * power
        value = (self.kd * dr.inv_pi + self.ks * lobe) * wo.z
        density = dr.lerp(lobe, wo.z * dr.inv_pi, self.diffuse_odds)
        return value & above, dr.select(above, density, 0)

    def _lobe_direction(self, wi, u):
        cos_alpha = dr.power(u.y, dr.rcp(self.n + 1))
        sin_alpha = dr.safe_sqrt(1 - dr.square(cos_alpha))
        sin_phi, cos_phi = dr.sincos(dr.two_pi * u.x)
        local = mi.Vector3f(cos_phi * sin_alpha, sin_phi * sin_alpha, cos_alpha)
        return mi.Frame3f(self._mirror(wi)).to_world(local)

    def sample(self, ctx, si, sample1, sample2, active=True):
        wi, = self._to_front(si.wi)
        diffuse = sample1 < self.diffuse_odds
        wo = dr.select(diffuse, mi.warp.square_to_cosine_hemisphere(sample2), self._lobe_direction(wi, sample2))
        value, density = self._value_and_pdf(wi, wo)
        active &= density > 0
        sample = mi.BSDFSample3f(mi.Vector3f(wo.x, wo.y, dr.mulsign(wo.z, si.wi.z)))
        sample.pdf = density
        sample.eta = 1
        sample.sampled_type = +mi.BSDFFlags.GlossyReflection
        sample.sampled_component = 0
        return sample, (value / density) & active

    def eval_pdf(self, ctx, si, wo, active=True):
        wi, wo = self._to_front(si.wi, wo)
        value, density = self._value_and_pdf(wi, wo)
        return value & active, dr.select(active, density, 0)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def to_string(self):
        return f"Phong[kd={self.kd}, ks={self.ks}, exponent={self.n}]"
