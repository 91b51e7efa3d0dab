"""How Cycles renders: soft, without fireflies, quickly on processors."""


def set_quality(scene, job):
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = job["width"], job["height"]
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.use_persistent_data = False
    scene.view_settings.view_transform = "Filmic"
    scene.view_settings.look = "High Contrast"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = job["samples"]
    cycles.use_adaptive_sampling = True
    cycles.adaptive_threshold = 0.02
    cycles.adaptive_min_samples = max(8, job["samples"] // 4)
    cycles.use_denoising = False  # Debian's Blender has no denoiser
    cycles.seed = job.get("seed", 0)
    # A ray through a drop crosses its surface twice, through a film's edge up to four times.
    cycles.max_bounces = 12
    cycles.transmission_bounces = 10
    cycles.glossy_bounces = 4
    cycles.diffuse_bounces = 2
    cycles.volume_bounces = 0
    cycles.transparent_max_bounces = 12
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.blur_glossy = 1.0
    cycles.sample_clamp_direct = 12.0
    cycles.sample_clamp_indirect = 3.0
